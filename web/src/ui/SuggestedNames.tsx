// The names that a language model suggests for the parts, a line each.

import { useId } from 'preact/hooks';
import { costOf, isDemo } from '../llm/settings';
import { nameOf } from '../session/document';
import { names } from '../session/name_suggestions';
import type { NameRow, Naming } from '../session/naming';
import { suggestFront } from '../session/placing';
import { document, pointedAt, task } from '../session/session';
import { plural, price, t } from '../texts/texts';
import { Icon } from './Icon';
import { sideName } from './words';

/** Nothing while no names are suggested. */
export function SuggestedNames() {
  const list = useId();
  const naming = names.naming.value;
  if (naming === null) return null;
  const labels = [...new Set(naming.rows.map(({ label }) => label).filter(Boolean))];
  return (
    <form
      class="names"
      onSubmit={(event) => {
        event.preventDefault();
        if (naming.front !== '') suggestFront(naming.model.files, naming.front);
        void names.accept();
      }}
    >
      <p class="quiet">{aboutWords(naming)}</p>
      <datalist id={list}>
        {labels.map((label) => (
          <option key={label} value={label} />
        ))}
      </datalist>
      <ul>
        {naming.rows.map((row) => (
          <Row key={row.part} naming={naming} row={row} list={list} />
        ))}
      </ul>
      <button type="submit" class="button primary" disabled={task.value !== null || labels.length === 0}>
        <Icon name="check" /> {t`Use these names`}
      </button>
    </form>
  );
}

function Row({ naming, row, list }: { naming: Naming; row: NameRow; list: string }) {
  const part = naming.model.shape.parts.find(({ id }) => id === row.part);
  if (part === undefined) return null;
  const show = () => {
    pointedAt.value = { parts: part.virtual ? part.members : [part.id], relations: [] };
  };
  const hide = () => {
    pointedAt.value = null;
  };
  const now = nameOf(document.value, part.id);
  const isSplit = row.votes !== null && row.votes < naming.of;
  return (
    <li onPointerEnter={show} onPointerLeave={hide}>
      <span class="quiet">{now}</span>
      <input
        type="text"
        maxLength={64}
        list={list}
        autocomplete="off"
        aria-label={t`Name of ${now}`}
        placeholder={t`keeps its name`}
        value={row.label}
        onFocus={show}
        onBlur={hide}
        onInput={(event) => names.rename(row.part, event.currentTarget.value)}
      />
      {isSplit && (
        <span class={2 * (row.votes ?? 0) <= naming.of ? 'unsure' : 'quiet'} title={t`Answers that say so`}>
          {t`${row.votes} of ${naming.of}`}
        </span>
      )}
    </li>
  );
}

const sides = { '+z': 'front', '-z': 'back', '+x': 'left', '-x': 'right', '': 'front' } as const;

function aboutWords({ front, of, spent }: Naming): string {
  const faces =
    front === '' || front === '+z' ? '' : t`It seems to face what is taken for its ${sideName(sides[front])}.`;
  const answers = isDemo.value ? t`Recorded answers.` : answersWords(of, spent);
  return [faces, t`Parts of one name are compared for symmetry; correct what is wrong.`, answers]
    .filter(Boolean)
    .join(' ');
}

function answersWords(of: number, { calls, tokens }: Naming['spent']): string {
  const cost = costOf(tokens);
  const answers = plural(of, '{n} answer', '{n} answers');
  return calls > 0 && cost !== null ? t`${answers}, cost ${price(cost)}.` : `${answers}.`;
}
