// A layer, or a whole program from elsewhere, as text: to read, copy, change and take over.

import { useComputed, useSignal } from '@preact/signals';
import { useRef } from 'preact/hooks';
import { parseJson } from '../program/json';
import { programText } from '../program/text';
import { checkProgramText, type TextError } from '../program/text_check';
import type { Layer, Program } from '../program/types';
import { programOf, withFreshParameters } from '../session/document';
import { titleOf } from '../session/layers';
import { playOnce } from '../session/play';
import { addProgram, document, entryOf, rewriteLayer } from '../session/session';
import { plural, t } from '../texts/texts';
import { dialog, textOf } from './actions';
import { Dialog } from './Dialog';
import { Icon } from './Icon';

const largestFile = 8 * 2 ** 20;

export function ProgramDialog() {
  const { model } = document.value;
  const entry = textOf.value === null ? undefined : entryOf(textOf.value);
  const original = model && entry ? programText(withoutReports(programOf(model.shape, [entry]))) : '';
  const text = useSignal(original);
  const copied = useSignal(false);
  const wrong = useSignal('');
  const field = useRef<HTMLTextAreaElement>(null);
  const read = useComputed(() => {
    const { shape } = document.value.model ?? {};
    return shape && text.value.trim() !== '' ? checkProgramText(text.value, shape) : null;
  });
  if (model === null) return null;
  const isNew = entry === undefined;
  const layers = read.value?.ok ? read.value.value.program.layers : [];
  const tooMany = !isNew && read.value?.ok && layers.length !== 1;
  const error = read.value && !read.value.ok ? (read.value.error as TextError) : null;
  const ready = layers.length > 0 && !tooMany && (isNew || text.value !== original);

  const close = () => {
    dialog.value = null;
  };
  const apply = () => {
    const [layer] = layers;
    if (!ready || layer === undefined || !read.value?.ok) return;
    close();
    if (isNew) {
      const keys = addProgram(read.value.value.program, t`add from text`);
      if (keys?.[0] !== undefined) playOnce(keys[0]);
    } else rewriteLayer(entry.key, ownName(layer, entry.layer, entry.key));
  };
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(text.value);
      copied.value = true;
    } catch {
      field.current?.select(); // no permission: the text is ready for Ctrl+C
    }
  };
  const goTo = ({ line, column }: TextError) => {
    const before = text.value.split('\n').slice(0, line - 1);
    const at = before.reduce((sum, content) => sum + content.length + 1, 0) + column - 1;
    field.current?.focus();
    field.current?.setSelectionRange(at, at + 1);
  };
  const load = async (file: File | undefined) => {
    if (file === undefined) return;
    wrong.value = file.size > largestFile ? t`${file.name} is too large for a program.` : '';
    if (wrong.value !== '') return;
    const content = await file.text();
    text.value = fromJson(content) ?? content;
  };
  return (
    <Dialog title={isNew ? t`Add edits from text` : t`${titleOf(entry.layer)}, as text`} class="text" onClose={close}>
      <p class="quiet">
        {isNew
          ? t`Paste a program, or open its file (.txt or .json). Its edits are added behind those that are there.`
          : t`One statement a line. Amounts are formulas of the slider, named after “layer”.`}
      </p>
      <textarea
        ref={field}
        class="program"
        spellcheck={false}
        autocapitalize="off"
        rows={16}
        wrap="off"
        aria-label={t`Program`}
        aria-invalid={error !== null}
        aria-describedby="program-error"
        value={text.value}
        onInput={(event) => {
          text.value = event.currentTarget.value;
          copied.value = false;
        }}
      />
      <p id="program-error" class="program-state" role="status">
        {wrong.value && <span class="error">{wrong.value}</span>}
        {error && (
          <button type="button" class="line error" onClick={() => goTo(error)}>
            <Icon name="warning" /> {t`Line ${error.line}, column ${error.column}: ${error.cause}; ${error.fix}.`}
          </button>
        )}
        {tooMany && <span class="error">{t`There should be one layer here. Add others by “Write as text”.`}</span>}
        {layers.length > 0 && !tooMany && (
          <span class="quiet">{t`${countWords(layers)}, all of it fits this model.`}</span>
        )}
      </p>
      <div class="row end">
        {isNew ? (
          <label class="button file">
            {t`From a file…`}
            <input
              type="file"
              class="visually-hidden"
              aria-label={t`Program from a file`}
              accept=".txt,.json,.parsel"
              onChange={(event) => void load(event.currentTarget.files?.[0])}
            />
          </label>
        ) : (
          <button type="button" class="button" onClick={copy}>
            {copied.value ? t`Copied` : t`Copy`}
          </button>
        )}
        <button type="button" class="button primary" disabled={!ready} onClick={apply}>
          {isNew ? t`Add` : t`Apply`}
        </button>
      </div>
    </Dialog>
  );
}

function countWords(layers: readonly Layer[]): string {
  const statements = layers.reduce((sum, layer) => sum + layer.statements.length, 0);
  const words = plural(statements, '{n} statement', '{n} statements');
  return layers.length === 1 ? words : `${plural(layers.length, '{n} edit', '{n} edits')}, ${words}`;
}

/** What was found out about relations is no part of what one writes. */
function withoutReports(program: Program): Program {
  return { ...program, layers: program.layers.map((layer) => ({ ...layer, relations: [] })) };
}

/** The layer under a parameter name that no other layer has; without reports that its new statements have not earned. */
function ownName(layer: Layer, before: Layer, key: number): Layer {
  const others = document.peek().layers.filter((entry) => entry.key !== key);
  const taken = new Set(others.map((entry) => entry.layer.parameter.name));
  const [named = layer] = withFreshParameters([layer], taken);
  const same = JSON.stringify(layer.statements) === JSON.stringify(before.statements);
  return { ...named, relations: same ? before.relations : [] };
}

/** The text form of a program in JSON; null for what is none. */
function fromJson(content: string): string | null {
  const json = parseJson(content);
  try {
    return json.ok ? programText(json.value as Program) : null;
  } catch {
    return null; // JSON, but no program
  }
}
