// Components that few visitors see: their code is fetched when they are shown for the first time.

import { signal } from '@preact/signals';
import type { ComponentType, VNode } from 'preact';
import { useEffect } from 'preact/hooks';
import { t } from '../texts/texts';

/**
 * A component without properties, whose code `load` fetches. Until it is there a line says so, inside what `around` makes of it;
 * a failed fetch can be tried again.
 */
export function lazily(
  load: () => Promise<ComponentType>,
  around: (line: VNode) => VNode = (line) => line,
): ComponentType {
  const loaded = signal<ComponentType | null>(null);
  const failed = signal(false);
  const fetchCode = () => {
    failed.value = false;
    load().then(
      (component) => {
        loaded.value = component;
      },
      () => {
        failed.value = true;
      },
    );
  };
  return function Lazily() {
    useEffect(() => {
      if (loaded.peek() === null) fetchCode();
    }, []);
    const Component = loaded.value;
    if (Component !== null) return <Component />;
    if (!failed.value) {
      return around(
        <p class="quiet" role="status">
          {t`Loading…`}
        </p>,
      );
    }
    return around(
      <p class="broken" role="alert">
        {t`This part of the page could not be fetched: is the network there?`}{' '}
        <button type="button" class="quiet" onClick={fetchCode}>
          {t`Try again`}
        </button>
      </p>,
    );
  };
}
