// One row a slider: name, value, a button that takes it back, the slider itself.
import { titleOf } from '../../../src/program/title';
import type { SliderParameter } from '../values';

export interface Controls {
  readonly list: HTMLUListElement;
  /** Where a slider stands now. */
  show(name: string, value: number): void;
}

/** An arrow key moves a slider by this share of its range; with Shift, or Page keys, ten times as far, with Alt a tenth. */
const steps = 200;

const format = new Intl.NumberFormat(undefined, { maximumFractionDigits: 3, signDisplay: 'exceptZero' });

/** @param move is told where a person puts a slider */
export function createControls(
  parameters: readonly SliderParameter[],
  move: (name: string, value: number) => void,
): Controls {
  const list = element('ul', 'sliders');
  const rows = new Map(parameters.map((parameter, i) => [parameter.name, createRow(parameter, `slider-${i}`, move)]));
  for (const { item } of rows.values()) list.append(item);
  return { list, show: (name, value) => rows.get(name)?.show(value) };
}

function createRow(parameter: SliderParameter, id: string, move: (name: string, value: number) => void) {
  const { name, min, max, value: initial } = parameter;
  const title = titleOf(parameter);
  const item = element('li', 'slider');
  const label = Object.assign(element('label', 'label'), { htmlFor: id, textContent: title });
  const value = Object.assign(element('output', 'value'), { htmlFor: id });
  const reset = Object.assign(element('button', 'reset'), { type: 'button', textContent: 'Reset' });
  reset.setAttribute('aria-label', `Reset: ${title}`);
  // The value last: it is cut to the range and the step that are there.
  const range = Object.assign(element('input', 'range'), { id, type: 'range' });
  Object.assign(range, { min: String(min), max: String(max), step: 'any', value: String(initial) });
  range.disabled = min === max;

  const put = (to: number) => move(name, Math.min(max, Math.max(min, to)));
  range.addEventListener('input', () => put(range.valueAsNumber));
  range.addEventListener('dblclick', () => put(0));
  reset.addEventListener('click', () => put(initial));
  range.addEventListener('keydown', (event) => {
    const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
    if (by === undefined || event.ctrlKey || event.metaKey) return;
    event.preventDefault(); // step="any" gives the arrows a step of 1 in some browsers
    const unit = (max - min) / steps;
    put(range.valueAsNumber + by * unit * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1));
  });
  item.append(label, value, reset, range);
  return {
    item,
    show(now: number) {
      range.valueAsNumber = now;
      const text = format.format(now);
      value.textContent = text;
      range.setAttribute('aria-valuetext', text);
      reset.disabled = now === initial;
    },
  };
}

/** An element that pages can style by its part. */
export function element<K extends keyof HTMLElementTagNameMap>(tag: K, part: string): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  made.setAttribute('part', part);
  return made;
}
