/** What a file leaves open, each answered by a click; what is taken without one is marked. */

import { knownOr, meaningText } from '../core/importing.js';
import { answer } from '../importing.js';
import { html } from '../libraries.js';
import { t } from '../texts.js';

/** Columns that are asked about at once; exports of some programs have dozens. */
const MOST_COLUMNS = 6;

/** All questions, in the order of the service; where many columns are unused, some folded away. */
export function Questions({ importing: { reply, mapping } }) {
  const { questions = [] } = reply;
  if (!questions.length) return null;
  const open = questions.filter(({ is_answered: isAnswered }) => !isAnswered).length;
  const columns = questions.filter(({ kind }) => kind === 'column').slice(MOST_COLUMNS);
  const folded = new Set(columns.length > 1 ? columns : []);
  const list = (isWanted) => html`<ol>${questions.map((question, at) => isWanted(question) &&
    html`<${Question} key=${question.id} at=${at} question=${question} reply=${reply}
      given=${mapping.answers?.[question.id]} />`)}</ol>`;
  return html`<section class="import-questions" aria-labelledby="import-questions-title">
    <h3 id="import-questions-title">${t('import.questions', { count: questions.length })}</h3>
    <p class="help">${
      open ? t('import.questionsOpen', { count: open }) : t('import.questionsDone')
    }</p>
    ${list((question) => !folded.has(question))}
    ${folded.size > 0 && html`<details><summary>${t('import.moreColumns', {
      count: folded.size,
    })}</summary>${list((question) => folded.has(question))}</details>`}</section>`;
}

function Question({ at, question, reply, given }) {
  const { id, kind, default: assumed, is_answered: isAnswered, examples } = question;
  const taken = given ?? question.answer;
  const column =
    kind === 'column' ? reply.columns.find((entry) => entry.column === question.column) : null;
  const choose = (chosen) => answer(id, chosen, column);
  const state = isAnswered ? 'answered' : taken === null ? 'wanted' : 'open';
  return html`<li class=${state}><div role="group" aria-labelledby=${`question-${at}`}>
    <p><span id=${`question-${at}`}>${textOf(question)}</span>
      ${examples?.length > 0 && html` <small>${examples.join(' \u00b7 ')}</small>`}</p>
    <div class="answers">${question.choices.map(({ answer: choice, title }) => html`<button
      type="button" key=${choice} aria-pressed=${taken === choice}
      onClick=${() => choose(choice)}>${titleOf(kind, choice, title)}${
        choice === assumed && !isAnswered && html` <small>${t('import.assumed')}</small>`
      }</button>`)}
    ${column && html`<${OtherMeaning} question=${question} column=${column} reply=${reply}
      onChoose=${choose} />`}</div></div></li>`;
}

/** Every meaning that a column may have beside the likely ones. */
function OtherMeaning({ question, column, reply, onChoose }) {
  const likely = question.choices.map((choice) => choice.answer);
  const name = column.heading || column.column;
  return html`<select aria-label=${t('import.otherMeaning', { name })}
    value=${likely.includes(column.meaning) ? '' : column.meaning}
    onChange=${(event) => onChoose(event.target.value)}>
    <option value="" disabled hidden>${t('import.other')}</option>
    ${reply.meanings
      .filter(({ meaning }) => !likely.includes(meaning))
      .map(({ meaning, title }) => html`<option key=${meaning}
        value=${meaning}>${meaningText(meaning, title)}</option>`)}</select>`;
}

/** Return a question in the reader's language, as the service has it where it is a new kind. */
function textOf({ kind, values, text }) {
  return knownOr(t(`import.question.${kind}`, values), text);
}

function titleOf(kind, choice, title) {
  if (kind === 'column') return meaningText(choice, title);
  return knownOr(t(`import.answer.${choice}`), title);
}
