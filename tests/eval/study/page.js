// The page of a study; questions.js says what is asked. See make.mjs.
const { study, frames, questions } = globalThis.parselStudy;
const element = (id) => document.getElementById(id);
const kept = `parsel study ${study}`;
function stored() {
  try {
    return JSON.parse(localStorage.getItem(kept)) ?? {};
  } catch {
    return {};
  }
}
const answers = stored();
const firstOpen = () => {
  const open = questions.findIndex(({ id }) => !answers[id]);
  return open < 0 ? questions.length : open;
};
let at = firstOpen();
let frame = 0;
let step = 0;
let plays = !matchMedia('(prefers-reduced-motion: reduce)').matches;

function showFrame() {
  for (const side of ['left', 'right']) element(side).style.backgroundPosition = `${(100 * frame) / (frames - 1)}% 0`;
  element('slider').value = frame;
}
function show() {
  element('ask').hidden = at >= questions.length;
  element('done').hidden = at < questions.length;
  element('progress').max = questions.length;
  element('progress').value = Object.keys(answers).length;
  if (at >= questions.length) return;
  const question = questions[at];
  element('request').textContent = `${at + 1} of ${questions.length}: “${question.request}”`;
  for (const side of ['left', 'right']) {
    element(side).style.backgroundImage = `url(${question[side]})`;
    element(side).style.backgroundSize = `${frames * 100}% 100%`;
  }
  for (const button of document.querySelectorAll('[data-answer]'))
    button.setAttribute('aria-pressed', String(answers[question.id] === button.dataset.answer));
  element('back').disabled = at === 0;
  frame = 0;
  step = 0;
  showFrame();
}
function answer(choice) {
  if (at >= questions.length) return;
  answers[questions[at].id] = choice;
  try {
    localStorage.setItem(kept, JSON.stringify(answers));
  } catch {
    /* a private window: they stay until it is closed */
  }
  at += 1;
  if (at >= questions.length) at = firstOpen();
  show();
}
function play(on) {
  plays = on;
  element('play').setAttribute('aria-pressed', String(on));
  element('play').textContent = on ? 'Stop' : 'Play';
}
function back() {
  if (at > 0) {
    at = Math.min(at, questions.length) - 1;
    show();
  }
}

element('slider').max = frames - 1;
element('slider').addEventListener('input', ({ target }) => {
  play(false);
  frame = Number(target.value);
  showFrame();
});
element('play').addEventListener('click', () => play(!plays));
element('back').addEventListener('click', back);
element('again').addEventListener('click', back);
for (const button of document.querySelectorAll('[data-answer]'))
  button.addEventListener('click', () => answer(button.dataset.answer));
element('save').addEventListener('click', () => {
  const text = JSON.stringify({ format: 'parsel/study', version: 1, study, by: 'a person', answers }, null, 1);
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type: 'application/json' }));
  link.download = `answers_${study}.json`;
  link.click();
});
addEventListener('keydown', (event) => {
  if (event.target.matches('input') || event.ctrlKey || event.metaKey || event.altKey) return;
  const choice = { ArrowLeft: 'left', ArrowDown: 'same', ArrowRight: 'right' }[event.key];
  if (choice) answer(choice);
  else if (event.key === 'Backspace') back();
  else if (event.key === ' ' && !event.target.matches('button')) play(!plays);
  else return;
  event.preventDefault();
});
/** Forwards and back again. */
setInterval(() => {
  if (!plays) return;
  step = (step + 1) % (2 * frames - 2);
  frame = step < frames ? step : 2 * frames - 2 - step;
  showFrame();
}, 160);
play(plays);
show();
