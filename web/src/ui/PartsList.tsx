// The list of parts: found by name, selected one or several at a time, folded, hidden and renamed. It is one stop of the
// Tab key: arrows walk it. Of a long list only what is in sight is drawn.

import { type Signal, useSignal } from '@preact/signals';
import { useEffect, useLayoutEffect, useMemo, useRef } from 'preact/hooks';
import type { ShapePart } from '../program/types';
import {
  document,
  hovered,
  renamePart,
  select,
  selectAll,
  selectAlso,
  selected,
  selection,
  setHidden,
} from '../session/session';
import { t } from '../texts/texts';
import { Icon } from './Icon';
import { type PartRow, partRows, rowsInSight } from './part_rows';
import { several } from './view';

/** As in style/parts.css. */
const rowHeight = 28;
/** Lists up to here scroll with the panel, and need no search. */
const mostShort = 12;

export function PartsList({ parts }: { parts: readonly ShapePart[] }) {
  const query = useSignal('');
  const opened = useSignal<ReadonlySet<string>>(new Set());
  const at = useSignal('');
  const scrolled = useSignal(0);
  const list = useRef<HTMLUListElement>(null);
  const { names } = document.value;
  const named = ({ id, name }: ShapePart) => names.get(id) ?? name;
  const chosen = new Set(selected.value);
  // What is selected changes the rows only where it opens a group.
  const holding = parts.filter(({ members }) => members.some((id) => chosen.has(id))).map(({ id }) => id);
  const rows = useMemo(() => {
    const open = new Set([...opened.value, ...holding]);
    return partRows(parts, { query: query.value, nameOf: named, isOpen: ({ id }) => open.has(id) });
  }, [parts, names, query.value, opened.value, holding.join(' ')]);
  const isLong = parts.length > mostShort;
  const [first, end] = rowsInSight(rows.length, rowHeight, scrolled.value, list.current?.clientHeight || 600);
  const indexOf = (id: string) =>
    Math.max(
      0,
      rows.findIndex(({ part }) => part.id === id),
    );
  const active = indexOf(at.value);

  const show = (index: number) => {
    const element = list.current;
    if (element === null || !isLong) return;
    const top = index * rowHeight;
    if (top < element.scrollTop) element.scrollTop = top;
    else if (top + rowHeight > element.scrollTop + element.clientHeight)
      element.scrollTop = top + rowHeight - element.clientHeight;
    scrolled.value = element.scrollTop;
  };
  const moveTo = (index: number, extend: boolean) => {
    const row = rows[Math.max(0, Math.min(rows.length - 1, index))];
    if (row === undefined) return;
    const from = rows[indexOf(at.peek())] ?? row;
    at.value = row.part.id;
    show(rows.indexOf(row));
    if (extend) selectRange(rows, selection.peek()?.part ?? from.part.id, row.part.id);
    // The row may only be drawn now that the list has scrolled.
    requestAnimationFrame(() => list.current?.querySelector<HTMLElement>('.name[tabindex="0"]')?.focus());
  };
  const fold = (group: ShapePart, open: boolean) => {
    const next = new Set(opened.value);
    if (open) next.add(group.id);
    else next.delete(group.id);
    opened.value = next;
  };
  const onKeyDown = (event: KeyboardEvent) => {
    if ((event.target as Element).matches('input')) return;
    // Keys may come faster than the list is drawn.
    const from = indexOf(at.peek());
    const row = rows[from];
    const to = { ArrowDown: from + 1, ArrowUp: from - 1, Home: 0, End: rows.length - 1 }[event.key];
    if (to !== undefined) moveTo(to, event.shiftKey);
    else if (event.key === 'ArrowRight' && row?.open === false) fold(row.part, true);
    else if (event.key === 'ArrowLeft' && row?.open) fold(row.part, false);
    else return;
    event.preventDefault();
  };
  // What is selected in the view is brought into sight here; what was selected here leaves the keyboard where it is.
  const shown = selection.value?.part;
  useEffect(() => {
    const index = rows.findIndex(({ part }) => part.id === shown);
    if (index < 0 || selected.peek().includes(at.peek())) return;
    at.value = shown ?? '';
    show(index);
  }, [shown]);
  useLayoutEffect(() => {
    if (list.current) list.current.scrollTop = scrolled.value = 0;
  }, [query.value]);

  return (
    <>
      <div class="parts-head">
        {isLong && (
          <input
            type="search"
            placeholder={t`Find among ${parts.filter(({ virtual }) => !virtual).length} parts`}
            aria-label={t`Find a part`}
            value={query.value}
            onInput={(event) => {
              query.value = event.currentTarget.value;
            }}
            onKeyDown={(event) => {
              if (event.key === 'Enter') selectAll(rows.filter(({ open }) => !open).map(({ part }) => part.id));
              else if (event.key === 'ArrowDown') moveTo(0, false);
              else return;
              event.preventDefault();
            }}
          />
        )}
        <button
          type="button"
          class={`button severally ${isLong ? 'icon-only' : 'quiet'}`}
          aria-pressed={several.value}
          aria-label={t`Select several`}
          title={t`Select several: clicks add to the selection (Shift+click does so at any time; Shift+drag draws a box)`}
          onClick={() => {
            several.value = !several.value;
          }}
        >
          <Icon name="several" />
          {!isLong && t`Select several`}
        </button>
      </div>
      <ul
        ref={list}
        class={`parts ${isLong ? 'long' : ''}`}
        onKeyDown={onKeyDown}
        onScroll={(event) => {
          if (rows.length > end - first) scrolled.value = event.currentTarget.scrollTop;
        }}
      >
        {first > 0 && <li aria-hidden="true" style={{ height: `${first * rowHeight}px` }} />}
        {rows.slice(first, end).map((row, i) => (
          <Row
            key={row.part.id}
            row={row}
            name={named(row.part)}
            isActive={active < first || active >= end ? i === 0 : active === first + i}
            position={rows.length > end - first ? [first + i + 1, rows.length] : null}
            onFold={(open) => fold(row.part, open)}
            onSelect={(event) => {
              at.value = row.part.id;
              onSelect(event, rows, row.part.id);
            }}
          />
        ))}
        {end < rows.length && <li aria-hidden="true" style={{ height: `${(rows.length - end) * rowHeight}px` }} />}
      </ul>
      {rows.length === 0 && <p class="quiet empty">{t`No part is called so.`}</p>}
    </>
  );
}

function selectRange(rows: readonly PartRow[], from: string, to: string): void {
  const [a, b] = [from, to].map((id) => rows.findIndex(({ part }) => part.id === id)) as [number, number];
  if (a < 0 || b < 0) {
    selectAlso(to); // the range begins at a row that is folded away, or does not match the search
    return;
  }
  const range = rows.slice(Math.min(a, b), Math.max(a, b) + 1).map(({ part }) => part.id);
  selectAll([from, ...range.filter((id) => id !== from)]);
}

/** A click selects, or lets go; with Shift up to here, with Ctrl this one as well. */
function onSelect(event: MouseEvent, rows: readonly PartRow[], id: string): void {
  const from = selection.peek()?.part;
  if (event.shiftKey && from !== undefined) selectRange(rows, from, id);
  else if (event.ctrlKey || event.metaKey || event.shiftKey || several.peek()) selectAlso(id);
  else select(selected.peek().length === 1 && from === id ? null : id);
}

interface RowProps {
  readonly row: PartRow;
  readonly name: string;
  /** The one that Tab reaches. */
  readonly isActive: boolean;
  /** Among all rows, where not all are drawn. */
  readonly position: readonly [number, number] | null;
  readonly onFold: (open: boolean) => void;
  readonly onSelect: (event: MouseEvent) => void;
}

function Row({ row: { part, inner, open }, name, isActive, position, onFold, onSelect }: RowProps) {
  const renaming = useSignal(false);
  const { hidden } = document.value;
  const ids = part.virtual ? part.members : [part.id];
  const isHidden = ids.every((id) => hidden.has(id));
  const isSelected = selected.value.includes(part.id);
  const tabIndex = isActive ? 0 : -1;
  return (
    <li
      class={`part ${isSelected ? 'selected' : ''} ${inner ? 'inner' : ''} ${isHidden ? 'hidden' : ''}`}
      aria-posinset={position?.[0]}
      aria-setsize={position?.[1]}
    >
      {open === null ? (
        <span class="twist" />
      ) : (
        <button
          type="button"
          class="twist"
          tabIndex={tabIndex}
          aria-expanded={open}
          aria-label={open ? t`${name}: fold` : t`${name}: unfold`}
          onClick={() => onFold(!open)}
        >
          <Icon name={open ? 'down' : 'right'} />
        </button>
      )}
      {renaming.value ? (
        <Rename part={part} name={name} renaming={renaming} />
      ) : (
        <button
          type="button"
          class="name"
          tabIndex={tabIndex}
          aria-pressed={isSelected}
          title={t`${name} (double-click or F2 renames)`}
          onClick={onSelect}
          onDblClick={() => {
            renaming.value = true;
          }}
          onKeyDown={(event) => {
            if (event.key === 'F2') renaming.value = true;
          }}
          onPointerEnter={() => {
            hovered.value = part.id;
          }}
          onPointerLeave={() => {
            hovered.value = null;
          }}
        >
          {name}
          {open !== null && <span class="quiet"> {part.members.length}</span>}
        </button>
      )}
      <button
        type="button"
        class="eye"
        tabIndex={tabIndex}
        aria-label={isHidden ? t`Show ${name}` : t`Hide ${name}`}
        title={isHidden ? t`Show` : t`Hide (H)`}
        onClick={() => setHidden(ids, !isHidden)}
      >
        <Icon name={isHidden ? 'eyeOff' : 'eye'} />
      </button>
    </li>
  );
}

function Rename({ part, name, renaming }: { part: ShapePart; name: string; renaming: Signal<boolean> }) {
  return (
    <input
      class="rename"
      value={name}
      maxLength={80}
      aria-label={t`New name of ${name}`}
      ref={(element) => element?.focus()}
      onBlur={(event) => {
        renaming.value = false;
        renamePart(part.id, event.currentTarget.value.trim());
      }}
      onKeyDown={(event) => {
        if (event.key === 'Escape') event.currentTarget.value = name;
        if (event.key === 'Enter' || event.key === 'Escape') event.currentTarget.blur();
      }}
    />
  );
}
