/** What a file leaves open, each answered by a click; what is taken without one is marked. */

import { knownOr } from '../core/importing.js';
import { answer } from '../importing.js';
import { html } from '../libraries.js';
import { t } from '../texts.js';

/** All questions, in the order of the service; those about columns stand in the table. */
export function Questions({ importing: { reply, mapping } }) {
  const questions = (reply.questions ?? []).filter(({ kind }) => kind !== 'column');
  if (!questions.length) return null;
  const open = questions.filter(({ is_answered: isAnswered }) => !isAnswered).length;
  return html`<section class="import-questions" aria-labelledby="import-questions-title">
    <h3 id="import-questions-title">${t('import.questions', { count: questions.length })}</h3>
    <p class="help">${open ? t('import.questionsOpen', { count: open }) : t('import.questionsDone')
    }</p>
    <ol>${questions.map((question, at) => html`<${Question} key=${question.id} at=${at}
      question=${question} given=${mapping.answers?.[question.id]} />`)}</ol></section>`;
}

function Question({ at, question, given }) {
  const { id, default: assumed, is_answered: isAnswered, examples } = question;
  const taken = given ?? question.answer;
  const state = isAnswered ? 'answered' : taken === null ? 'wanted' : 'open';
  return html`<li class=${state}><div role="group" aria-labelledby=${`question-${at}`}>
    <p><span id=${`question-${at}`}>${textOf(question)}</span>
      ${examples?.length > 0 && html` <small>${examples.join(' \u00b7 ')}</small>`}</p>
    <div class="answers">${question.choices.map(({ answer: choice, title }) => html`<button
      type="button" key=${choice} aria-pressed=${taken === choice}
      onClick=${() => answer(id, choice)}>${knownOr(t(`import.answer.${choice}`), title)}${
        choice === assumed && !isAnswered && html` <small>${t('import.assumed')}</small>`
      }</button>`)}</div></div></li>`;
}

/** Return a question in the reader's language, as the service has it where it is a new kind. */
function textOf({ kind, values, text }) {
  return knownOr(t(`import.question.${kind}`, values), text);
}
