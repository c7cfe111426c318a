/** Server-sent events from the text of a stream. */

/** Return a function that takes pieces of text and calls `onEvent({event, id, data})`. */
export function eventReader(onEvent) {
  let rest = '';
  return (text) => {
    rest += text;
    // A carriage return at the end may be half of a line's end.
    const whole = rest.endsWith('\r') ? rest.length - 1 : rest.length;
    rest = rest.slice(0, whole).replace(/\r\n?/g, '\n') + rest.slice(whole);
    let end = rest.indexOf('\n\n');
    while (end >= 0) {
      const event = parseEvent(rest.slice(0, end));
      if (event) onEvent(event);
      rest = rest.slice(end + 2);
      end = rest.indexOf('\n\n');
    }
  };
}

function parseEvent(block) {
  const found = { event: 'message', id: null, data: [] };
  for (const line of block.split('\n')) {
    const [, field, value] = /^([a-z]+): ?(.*)$/s.exec(line) ?? [];
    if (field === 'event' || field === 'id') found[field] = value;
    if (field === 'data') found.data.push(value);
  }
  return found.data.length ? { ...found, data: found.data.join('\n') } : null;
}
