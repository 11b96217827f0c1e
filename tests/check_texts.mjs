// Holds what the page says against its dictionaries (web/src/texts): every sentence of the code is marked and has its
// translation, no translation is left over, and both have the same places for values. Run by `npm run lint`;
// --missing prints the sentences that a dictionary lacks, as JSON to be filled in.
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { argv } from 'node:process';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';

const src = join(dirname(fileURLToPath(import.meta.url)), '../web/src');
const rooms = ['ui', 'session', 'llm', 'share'];
/** Attributes that are read or read out. */
const spoken = new Set([
  'aria-label',
  'aria-valuetext',
  'title',
  'placeholder',
  'label',
  'alt',
  'help',
  'nothing',
  'whole',
]);
/** Calls whose first text is shown. */
const says = new Set(['say', 'run', 'FileError', 'AskError', 'change', 'refused']);
/** What these say is said to language models, read as plain requests, or printed by the build: in English. */
const english = new Set([
  'llm/structure.ts',
  'session/looking.ts',
  'session/side_words.ts',
  'session/model_hosts.ts',
  'ui/debug.ts',
]);
/** Texts that nobody reads: of selectors, to a language model, of mistakes of our own. */
const unread = new Set([
  'button, summary, input, a',
  'Reply with the one word: ready',
  'The vote is decided.',
  'there is no model to save the work on',
]);
/** Names and units, the same in every language. */
const untranslated = /^[\s·,.:;()×%]*(ParSEL|OpenSCAD|kB|mm)?[\s·,.:;()×%]*$/;

/** Of a template with its values: "Fold {0}". */
const keyOf = (template) =>
  ts.isNoSubstitutionTemplateLiteral(template)
    ? template.text
    : template.templateSpans.reduce((text, { literal }, i) => `${text}{${i}}${literal.text}`, template.head.text);

/** Four words and more are for people, wherever they stand. */
const isSentence = (node) =>
  /(\b[a-z’']+[,:;]? ){3}[a-z’']+/i.test(keyOfText(node)) &&
  !ts.isTaggedTemplateExpression(node.parent) &&
  !(ts.isPropertyAssignment(node.parent) && node.parent.name === node) &&
  !(ts.isCallExpression(node.parent) && node.parent.expression.getText() === 'plural') &&
  !(ts.isJsxAttribute(node.parent) && !spoken.has(node.parent.name.getText()));

const hasWords = (text) => /[a-z]{2}/i.test(text);
const isText = (node) =>
  ts.isStringLiteral(node) || ts.isNoSubstitutionTemplateLiteral(node) || ts.isTemplateExpression(node);
const isInFunction = (node) => ts.findAncestor(node, ts.isFunctionLike) !== undefined;

/**
 * What a file says.
 * @returns keys: sentences, with whether they have plural forms; faults: what a reader of another language would see in
 *   English, with lines
 */
export function saidIn(file, code) {
  const tree = ts.createSourceFile(file, code, ts.ScriptTarget.Latest, true);
  const keys = new Map();
  const faults = [];
  const fault = (node, what) =>
    faults.push(`${file}:${tree.getLineAndCharacterOfPosition(node.getStart()).line + 1}: ${what}`);
  const shows = (node) => {
    if (node === undefined) return;
    if (isText(node) && hasWords(keyOfText(node)) && !untranslated.test(keyOfText(node)))
      fault(node, `“${keyOfText(node)}” is shown, but not marked with t`);
    if (ts.isConditionalExpression(node)) [node.whenTrue, node.whenFalse].forEach(shows);
    if (ts.isParenthesizedExpression(node)) shows(node.expression);
    if (ts.isBinaryExpression(node) && ['&&', '||', '??'].includes(node.operatorToken.getText())) shows(node.right);
  };
  const visit = (node) => {
    if (ts.isTaggedTemplateExpression(node)) {
      const tag = node.tag.getText();
      if (tag === 't' || tag === 'm') keys.set(keyOf(node.template), { hasForms: false });
      if (tag === 't' && !isInFunction(node))
        fault(node, 't before the language is known: mark it with m, say it with t');
      if (tag === 'm' && ts.isTemplateExpression(node.template)) fault(node, 'm takes no values: write {0}');
    }
    if (ts.isCallExpression(node) && node.expression.getText() === 'plural') {
      const [, one, many] = node.arguments;
      if (one && many && ts.isStringLiteral(one) && ts.isStringLiteral(many))
        keys.set(many.text, { hasForms: true, one: one.text });
      else fault(node, 'plural takes its two forms as plain texts');
    }
    if (isText(node) && isSentence(node) && !english.has(file) && !unread.has(keyOfText(node))) shows(node);
    if (ts.isJsxText(node) && hasWords(node.text) && !untranslated.test(node.text))
      fault(node, `“${node.text.trim()}” is shown, but not marked with t`);
    if (ts.isJsxExpression(node) && !ts.isJsxAttribute(node.parent)) shows(node.expression);
    if (ts.isJsxAttribute(node) && spoken.has(node.name.getText()))
      shows(node.initializer && ts.isJsxExpression(node.initializer) ? node.initializer.expression : node.initializer);
    if ((ts.isCallExpression(node) || ts.isNewExpression(node)) && says.has(node.expression.getText()))
      for (const argument of node.arguments ?? [])
        if (isText(argument) && / /.test(keyOfText(argument))) shows(argument);
    ts.forEachChild(node, visit);
  };
  visit(tree);
  return { keys, faults };
}

const keyOfText = (node) => (ts.isStringLiteral(node) ? node.text : keyOf(node).replace(/\{\d+\}/g, ''));

/** "{0}", "{n}", "<a>": what a sentence and its translation both need. */
const places = (text) => [...new Set(text.match(/\{\w+\}|<\w+>/g) ?? [])].sort().join(' ');

/** What is wrong with the dictionary of a language. */
export function dictionaryFaults(language, words, keys) {
  const { pluralCategories } = new Intl.PluralRules(language).resolvedOptions();
  const faults = [];
  for (const [key, { hasForms, one = key }] of keys) {
    const said = words[key];
    if (said === undefined) faults.push(`“${key}” is missing`);
    else if (typeof said === 'string') {
      if (places(said) !== places(key)) faults.push(`“${key}” has ${places(key)}, its translation ${places(said)}`);
      if (said.trim() === '') faults.push(`“${key}” is translated by nothing`);
      if (hasForms) faults.push(`“${key}” needs its plural forms: ${pluralCategories.join(', ')}`);
    } else if (!hasForms) faults.push(`“${key}” has no plural forms`);
    else {
      for (const form of pluralCategories)
        if (said[form] === undefined) faults.push(`“${key}” lacks its form “${form}”`);
      for (const [form, text] of Object.entries(said)) {
        if (!pluralCategories.includes(form))
          faults.push(`“${key}” has a form “${form}” that ${language} does not know`);
        const allowed = new Set([...places(one).split(' '), ...places(key).split(' ')]);
        for (const place of places(text).split(' ')) if (!allowed.has(place)) faults.push(`“${key}” has no ${place}`);
        if (form === 'other' && places(text) !== places(key))
          faults.push(`“${key}” has ${places(key)}, its translation ${places(text)}`);
      }
    }
  }
  for (const key of Object.keys(words)) if (!keys.has(key)) faults.push(`“${key}” is said nowhere`);
  return faults;
}

if (argv[1] === fileURLToPath(import.meta.url)) {
  const files = rooms
    .flatMap((room) =>
      readdirSync(join(src, room), { recursive: true, encoding: 'utf8' }).map((file) => join(room, file)),
    )
    .filter((file) => /\.tsx?$/.test(file));
  const said = ['main.tsx', 'texts/texts.ts', ...files].map((file) =>
    saidIn(file, readFileSync(join(src, file), 'utf8')),
  );
  const keys = new Map(said.flatMap((one) => [...one.keys]));
  const faults = said.flatMap((one) => one.faults.map((fault) => `web/src/${fault}`));
  for (const file of readdirSync(join(src, 'texts')).filter((name) => name.endsWith('.json'))) {
    const words = JSON.parse(readFileSync(join(src, 'texts', file), 'utf8'));
    if (argv.includes('--missing')) {
      const missing = [...keys].filter(([key]) => words[key] === undefined);
      const empty = missing.map(([key, { hasForms }]) => [key, hasForms ? { one: '', other: '' } : '']);
      process.stdout.write(`${JSON.stringify(Object.fromEntries(empty), null, 2)}\n`);
      process.exit();
    }
    const wrong = dictionaryFaults(file.slice(0, -'.json'.length), words, keys);
    faults.push(...wrong.map((fault) => `web/src/texts/${file}: ${fault}`));
  }
  if (faults.length > 0) {
    process.stderr.write(`${faults.join('\n')}\nHow to add a sentence: CONTRIBUTING.md.\n`);
    process.exit(1);
  }
}
