// Ctrl+C, and what a cluster sends before it ends a job (SIGTERM): the first time what runs is finished, the second time
// it is left.

export interface Interrupt {
  /** Whether somebody asked to end. */
  readonly asked: boolean;
  /** Listens no longer. */
  release(): void;
}

/** @param first what to do at the first signal; @param second at the next */
export function onInterrupt(first: () => void, second: () => void): Interrupt {
  let times = 0;
  const listener = () => {
    ++times;
    if (times === 1) first();
    else second();
  };
  const signals = ['SIGINT', 'SIGTERM'] as const;
  for (const signal of signals) process.on(signal, listener);
  return {
    get asked() {
      return times > 0;
    },
    release() {
      for (const signal of signals) process.off(signal, listener);
    },
  };
}
