// What the page is doing that takes time, one thing at a time, and what it has to say.

import { type ReadonlySignal, type Signal, signal } from '@preact/signals';
import { AskError } from '../llm/ask_error';
import { t } from '../texts/texts';
import type { Progress } from '../worker/protocol';
import { stepWords } from './core_steps';
import { FileError } from './files';

/** A sentence that stays until the next thing is done. */
export interface Notice {
  readonly kind: 'info' | 'error';
  readonly text: string;
}

/** What the core is doing, with a way to stop it. */
export interface Task {
  readonly text: string;
  readonly cancel: () => void;
}

export interface RunOptions {
  readonly signal: AbortSignal;
  readonly onProgress: (progress: Progress) => void;
}

export interface Tasks {
  readonly notice: Signal<Notice | null>;
  readonly task: ReadonlySignal<Task | null>;
  say(text: string, kind?: Notice['kind']): void;
  /** Runs something that takes time, with progress and cancel; says what went wrong. Null when it did. */
  run<T>(text: string, work: (options: RunOptions) => Promise<T>): Promise<T | null>;
}

export function createTasks(): Tasks {
  const notice = signal<Notice | null>(null);
  const task = signal<Task | null>(null);
  const say = (text: string, kind: Notice['kind'] = 'info') => {
    notice.value = { kind, text };
  };

  async function run<T>(text: string, work: (options: RunOptions) => Promise<T>): Promise<T | null> {
    task.peek()?.cancel();
    const controller = new AbortController();
    const own: Task = { text, cancel: () => controller.abort() };
    const isCurrent = () => task.peek()?.cancel === own.cancel;
    task.value = own;
    notice.value = null;
    try {
      return await work({
        signal: controller.signal,
        onProgress({ step, done, total }) {
          if (!isCurrent()) return;
          const now = `${text} · ${stepWords(step)}`;
          task.value = { ...own, text: total > 1 ? t`${now}, ${done} of ${total}` : now };
        },
      });
    } catch (error) {
      if (!controller.signal.aborted) say(sentence(error), 'error');
      return null;
    } finally {
      if (isCurrent()) task.value = null;
    }
  }

  return { notice, task, say, run };
}

/** An error as a whole sentence for people. */
export function sentence(error: unknown): string {
  const text = error instanceof Error ? error.message : String(error);
  if (error instanceof FileError) return text;
  const whole = text || t`something went wrong`;
  const capital = whole.charAt(0).toUpperCase() + whole.slice(1);
  return /[.!?]$/.test(capital) ? capital : `${capital}.`;
}

/** Why something was not answered, for people. */
export interface Failed {
  readonly text: string;
  /** Whether the settings of the language model can cure it. */
  readonly isSetting: boolean;
}
export const failureOf = (error: unknown): Failed => ({
  text: sentence(error),
  isSetting: error instanceof AskError && error.isSetting,
});
