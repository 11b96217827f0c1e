// A button with a list of commands below it: closes on Escape, on a choice and on a click elsewhere; arrows walk.
import { useSignal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { useEffect, useRef } from 'preact/hooks';

export interface MenuItem {
  readonly label: string;
  /** Of the label, where it is not that of the page. */
  readonly lang?: string;
  readonly hint?: string;
  readonly disabled?: boolean;
  readonly act: () => void;
}

interface MenuProps {
  /** Accessible name of the button when its children are an icon. */
  readonly label: string;
  readonly class?: string;
  readonly items: readonly MenuItem[];
  readonly children: ComponentChildren;
}

export function Menu({ label, items, children, ...rest }: MenuProps) {
  const open = useSignal(false);
  const root = useRef<HTMLDivElement>(null);
  const buttons = () => [...(root.current?.querySelectorAll<HTMLButtonElement>('[role=menuitem]') ?? [])];

  useEffect(() => {
    if (!open.value) return;
    buttons()[0]?.focus();
    const outside = (event: PointerEvent) => {
      if (!root.current?.contains(event.target as Node)) open.value = false;
    };
    addEventListener('pointerdown', outside);
    return () => removeEventListener('pointerdown', outside);
  }, [open.value]);

  const onKeyDown = (event: KeyboardEvent) => {
    if (!open.value) return;
    const all = buttons();
    const at = all.indexOf(globalThis.document.activeElement as HTMLButtonElement);
    const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: all.length - 1 }[event.key];
    if (to !== undefined) all[(to + all.length) % all.length]?.focus();
    else if (event.key === 'Escape') {
      open.value = false;
      root.current?.querySelector('button')?.focus();
    } else return;
    event.preventDefault();
    event.stopPropagation();
  };

  return (
    // biome-ignore lint/a11y/noStaticElementInteractions: the keys belong to the buttons inside
    <div class="menu" ref={root} onKeyDown={onKeyDown}>
      <button
        type="button"
        class={rest.class ?? 'button'}
        aria-label={label}
        title={label}
        aria-haspopup="menu"
        aria-expanded={open.value}
        onClick={() => {
          open.value = !open.value;
        }}
      >
        {children}
      </button>
      {open.value && (
        <div class="menu-list panel" role="menu" aria-label={label}>
          {items.map((item) => (
            <button
              key={item.label}
              type="button"
              role="menuitem"
              lang={item.lang}
              aria-disabled={item.disabled ?? false}
              onClick={() => {
                if (item.disabled) return;
                open.value = false;
                root.current?.querySelector('button')?.focus();
                item.act();
              }}
            >
              {item.label}
              {item.hint && <span class="quiet">{item.hint}</span>}
            </button>
          ))}
        </div>
      )}
    </div>
  );
}
