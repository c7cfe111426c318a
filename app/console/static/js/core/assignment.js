/** Whom to pair with whom so that the sum of what pairs are worth is the greatest. */

/**
 * Return for each row the column it is paired with; -1 where there are fewer columns than rows.
 *
 * The Hungarian method with potentials, row after row along the shortest augmenting path: for n
 * rows at most n * columns^2 steps, far fewer where most rows have a column of their own.
 *
 * @param worth a matrix of numbers, rows of equal length
 */
export function bestAssignment(worth) {
  const rows = worth.length;
  const columns = worth[0]?.length ?? 0;
  if (rows > columns) return turned(bestAssignment(transposed(worth, columns)), rows);
  const state = {
    rowPotential: new Float64Array(rows + 1),
    columnPotential: new Float64Array(columns + 1),
    rowOf: new Int32Array(columns + 1), // 1-based; column 0 holds the row that is placed
  };
  for (let row = 1; row <= rows; row += 1) place(worth, row, columns, state);
  const found = Array(rows).fill(-1);
  for (let column = 1; column <= columns; column += 1) {
    if (state.rowOf[column]) found[state.rowOf[column] - 1] = column - 1;
  }
  return found;
}

function transposed(worth, columns) {
  return Array.from({ length: columns }, (_, column) => worth.map((row) => row[column]));
}

function turned(found, rows) {
  const pairs = Array(rows).fill(-1);
  found.forEach((row, column) => {
    pairs[row] = column;
  });
  return pairs;
}

/** Give a row a column, where need be by moving rows that have one. In place. */
function place(worth, row, columns, { rowPotential, columnPotential, rowOf }) {
  const least = new Float64Array(columns + 1).fill(Infinity);
  const cameFrom = new Int32Array(columns + 1);
  const visited = new Uint8Array(columns + 1);
  rowOf[0] = row;
  let column = 0;
  while (rowOf[column]) {
    visited[column] = 1;
    const from = rowOf[column];
    let next = 0;
    let step = Infinity;
    for (let other = 1; other <= columns; other += 1) {
      if (visited[other]) continue;
      const cost = -worth[from - 1][other - 1] - rowPotential[from] - columnPotential[other];
      if (cost < least[other]) {
        least[other] = cost;
        cameFrom[other] = column;
      }
      if (least[other] < step) [step, next] = [least[other], other];
    }
    for (let other = 0; other <= columns; other += 1) {
      if (visited[other]) {
        rowPotential[rowOf[other]] += step;
        columnPotential[other] -= step;
      } else least[other] -= step;
    }
    column = next;
  }
  while (column) {
    rowOf[column] = rowOf[cameFrom[column]];
    column = cameFrom[column];
  }
}
