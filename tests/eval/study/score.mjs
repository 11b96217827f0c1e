// What the answers to a study say: which variant was preferred, how often neither, and how often whoever answered said the
// same of both orders.
//   node tests/eval/study/score.mjs KEY.json ANSWERS.json…
// ANSWERS: {"format": "parsel/study", "version": 1, "study", "by", "answers": {question: "left" | "right" | "same"}}.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

/** "a", "b" or "same", by what stood on which side. */
export const chosen = ({ left }, answer) => {
  if (answer === 'same') return 'same';
  const right = left === 'a' ? 'b' : 'a';
  return answer === 'left' ? left : right;
};

/**
 * @param key {key: [{id, index, left}], alike: [indices]}. @param answers question → "left" | "right" | "same"
 * @returns {comparisons, a, b, ties, agreement, answers, left}: comparisons are decided by both orders together (one that says
 *   a and one that says the same is half a vote for a); agreement: share in which both orders got the same answer; left: share
 *   of the answers that are not ties which chose the left side
 */
export function score({ key, alike }, answers) {
  const byIndex = new Map();
  let [left, decided] = [0, 0];
  for (const question of key) {
    const answer = answers[question.id];
    if (!['left', 'right', 'same'].includes(answer)) continue;
    if (answer !== 'same') decided++;
    if (answer === 'left') left++;
    byIndex.set(question.index, [...(byIndex.get(question.index) ?? []), chosen(question, answer)]);
  }
  const result = { comparisons: 0, a: 0, b: 0, ties: 0, agreement: 0, answers: 0, left: 0 };
  let both = 0;
  for (const list of byIndex.values()) {
    result.comparisons++;
    result.answers += list.length;
    const lead = list.filter((one) => one === 'a').length - list.filter((one) => one === 'b').length;
    result[lead > 0 ? 'a' : lead < 0 ? 'b' : 'ties']++;
    if (list.length === 2) {
      both++;
      if (list[0] === list[1]) result.agreement++;
    }
  }
  result.agreement = both === 0 ? 1 : result.agreement / both;
  result.left = decided === 0 ? 0.5 : left / decided;
  result.comparisons += alike.length;
  result.ties += alike.length;
  return result;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [keyFile, ...files] = process.argv.slice(2);
  if (files.length === 0) throw new Error('usage: node score.mjs KEY.json ANSWERS.json…');
  const key = JSON.parse(readFileSync(keyFile, 'utf8'));
  const percent = (x) => `${(100 * x).toFixed(1)} %`;
  for (const file of files) {
    const { study, by, answers } = JSON.parse(readFileSync(file, 'utf8'));
    if (study !== key.study) throw new Error(`${file} answers study ${study}, not ${key.study}.`);
    const { comparisons, a, b, ties, agreement, left } = score(key, answers);
    const decided = Math.max(1, a + b);
    process.stdout.write(
      `${by}: of ${comparisons} comparisons ${a} for ${key.a}, ${b} for ${key.b}, ${ties} ties (${key.alike.length} look alike); ` +
        `${key.a} is preferred in ${percent(a / decided)} of those decided; ` +
        `both orders agree in ${percent(agreement)}; left was chosen in ${percent(left)}\n`,
    );
  }
}
