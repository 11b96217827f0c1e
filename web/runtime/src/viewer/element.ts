// <parsel-viewer>: a model with its sliders, on the page's own stage.
import { type Actor, Stage } from '../../../src/scene/stage';
import { ParselError } from '../error';
import { misfitOf } from '../three/fit';
import type { SliderParameter } from '../values';
import { SliderValues } from '../values';
import { type Controls, createControls, element } from './controls';
import { type ReadModel, read } from './read';
import { style } from './style';

export interface ViewerEvents {
  /** The model stands on the stage. */
  'parsel-load': CustomEvent<{ readonly parameters: readonly SliderParameter[] }>;
  /** A slider has moved, by a person or by set() and reset(). */
  'parsel-change': CustomEvent<{ readonly name: string; readonly value: number; readonly values: Values }>;
  /** Nothing is shown, and why. */
  'parsel-error': CustomEvent<Pick<ParselError, 'place' | 'cause' | 'fix' | 'message'>>;
}
type Values = Readonly<Record<string, number>>;

/** Servers that render pages import modules as well, and have no elements. */
const Base = globalThis.HTMLElement ?? (class {} as typeof HTMLElement);
const watched = ['src', 'program', 'shape', 'theme', 'alt'] as const;
type Attribute = (typeof watched)[number];

/** Radians a key turns the camera, and the factor by which it comes nearer. */
const turnStep = Math.PI / 24;
const zoomStep = 1.15;

const query = (text: string) => globalThis.matchMedia?.(text) ?? { matches: false };
const colours = {
  light: { accent: '#2361cf', quiet: '#5a5f66', dark: false },
  dark: { accent: '#7fabff', quiet: '#a4a9b0', dark: true },
} as const;

export class ParselViewer extends Base {
  static readonly observedAttributes: readonly string[] = watched;

  readonly #stagePlace = element('div', 'stage');
  readonly #controlPlace = document.createElement('slot');
  readonly #message = element('p', 'message');
  #canvas: HTMLCanvasElement | null = null;
  #stage: Stage | null = null;
  #actor: Actor | null = null;
  #controls: Controls | null = null;
  #model: ReadModel | null = null;
  #values = new SliderValues([]);
  #loading: AbortController | null = null;
  #disconnect: AbortController | null = null;
  #queued = false;

  constructor() {
    super();
    const root = this.attachShadow({ mode: 'open' });
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(style);
    root.adoptedStyleSheets = [sheet];
    this.#stagePlace.className = 'stage';
    this.#message.className = 'message';
    this.#message.setAttribute('aria-live', 'polite');
    this.#controlPlace.name = 'controls';
    const panel = element('section', 'controls');
    panel.className = 'controls';
    panel.setAttribute('aria-label', 'Sliders');
    panel.append(this.#controlPlace, document.createElement('slot'));
    this.#stagePlace.append(this.#message);
    root.append(this.#stagePlace, panel);
  }

  connectedCallback(): void {
    this.#disconnect = new AbortController();
    const { signal } = this.#disconnect;
    const dark = query('(prefers-color-scheme: dark)');
    if ('addEventListener' in dark) dark.addEventListener('change', () => this.#setTheme(), { signal });
    this.#reload();
  }

  disconnectedCallback(): void {
    this.#disconnect?.abort();
    this.#loading?.abort();
    this.#clear();
    this.#stage?.dispose();
    this.#canvas?.remove();
    this.#stage = this.#canvas = null;
  }

  attributeChangedCallback(name: Attribute, before: string | null, now: string | null): void {
    if (before === now || !this.isConnected) return;
    if (name === 'theme') this.#setTheme();
    else if (name === 'alt') this.#describe();
    else this.#reload();
  }

  // ------------------------------------------------------------------------------------------------- what pages use

  get src(): string {
    return this.getAttribute('src') ?? '';
  }
  set src(value: string) {
    this.setAttribute('src', value);
  }
  get program(): string | null {
    return this.getAttribute('program');
  }
  set program(value: string | null) {
    if (value === null) this.removeAttribute('program');
    else this.setAttribute('program', value);
  }

  /** Of the model that is shown; empty while there is none. */
  get parameters(): readonly SliderParameter[] {
    return this.#model?.program.parameters ?? [];
  }

  /** Where the sliders stand, by name. */
  get values(): Values {
    return this.#values.byName;
  }

  /** Moves a slider; beyond its range it stops at the end. Throws a ParselError for an unknown name or no number. */
  set(name: string, value: number): void {
    if (!this.#values.set(name, value)) return;
    this.#show();
    const { values } = this;
    this.#tell('parsel-change', { name, value: values[name] ?? 0, values });
  }

  /** Puts every slider where it stood in the program. */
  reset(): void {
    for (const { name, value } of this.parameters) this.set(name, value);
  }

  // ------------------------------------------------------------------------------------------------------- loading

  /** Once for all attributes that change together. */
  #reload(): void {
    if (this.#queued) return;
    this.#queued = true;
    queueMicrotask(() => {
      this.#queued = false;
      if (this.isConnected) void this.#load();
    });
  }

  async #load(): Promise<void> {
    this.#loading?.abort();
    this.#clear();
    const { src, program } = this;
    if (src === '') return;
    const loading = new AbortController();
    this.#loading = loading;
    this.#say('Loading the model…', 'loading');
    try {
      this.#startStage();
      const model = await read({ src, program, shape: this.getAttribute('shape') }, loading.signal);
      this.#present(model);
      this.#say('', '');
      this.#tell('parsel-load', { parameters: this.parameters });
    } catch (error) {
      if (!loading.signal.aborted) this.#fail(error);
    }
  }

  #startStage(): void {
    if (this.#stage !== null) return;
    const canvas = element('canvas', 'canvas');
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'img');
    this.#stagePlace.prepend(canvas);
    try {
      this.#stage = new Stage(canvas, query('(prefers-reduced-motion: reduce)').matches);
    } catch {
      canvas.remove();
      const fix = 'switch hardware acceleration on, or use another browser';
      throw new ParselError({ stage: 'runtime/viewer', place: '', cause: 'this browser draws no WebGL 2', fix });
    }
    this.#canvas = canvas;
    canvas.addEventListener('keydown', (event) => this.#onKey(event));
    this.#setTheme();
    this.#describe();
  }

  #present(model: ReadModel): void {
    const stage = this.#stage as Stage;
    const { program, evaluate, loaded } = model;
    const actor = stage.show(loaded, evaluate.shape);
    const misfit = misfitOf(actor.view, evaluate.shape);
    if (misfit !== null) {
      stage.clear();
      throw misfit;
    }
    this.#actor = actor;
    this.#model = model;
    this.#values = new SliderValues(program.parameters);
    this.#controls = createControls(program.parameters, (name, value) => this.set(name, value));
    this.#controlPlace.replaceChildren(this.#controls.list);
    for (const [i, { id }] of evaluate.shape.parts.entries()) actor.view.setHidden(i, program.hidden.includes(id));
    this.#show();
    stage.fit(null, false);
  }

  #show(): void {
    if (this.#model === null) return;
    const { evaluate } = this.#model;
    this.#stage?.update({ corners: evaluate(this.#values.list), groups: evaluate.groups });
    for (const [name, value] of Object.entries(this.values)) this.#controls?.show(name, value);
  }

  #clear(): void {
    this.#stage?.clear();
    this.#actor = null;
    this.#model = null;
    this.#controls = null;
    this.#values = new SliderValues([]);
    this.#controlPlace.replaceChildren();
    this.#say('', '');
  }

  // ---------------------------------------------------------------------------------------------- words and colours

  #fail(error: unknown): void {
    const { place, cause, fix, message } =
      error instanceof ParselError
        ? error
        : new ParselError({
            stage: 'runtime/viewer',
            place: this.src,
            cause: String(error),
            fix: 'please report this',
          });
    this.#say(`This model cannot be shown. ${place === '' ? '' : `${place}: `}${cause}. To mend it, ${fix}.`, 'error');
    this.#tell('parsel-error', { place, cause, fix, message });
  }

  #say(text: string, kind: 'loading' | 'error' | ''): void {
    this.#message.className = `message ${kind}`;
    this.#message.setAttribute('role', kind === 'error' ? 'alert' : 'status');
    this.#message.textContent = text;
  }

  #tell<K extends keyof ViewerEvents>(type: K, detail: ViewerEvents[K]['detail']): void {
    this.dispatchEvent(new CustomEvent(type, { detail, bubbles: true, composed: true }));
  }

  #setTheme(): void {
    const chosen = this.getAttribute('theme');
    const dark = chosen === 'dark' || (chosen !== 'light' && query('(prefers-color-scheme: dark)').matches);
    this.#stage?.setTheme(colours[dark ? 'dark' : 'light']);
  }

  #describe(): void {
    this.#canvas?.setAttribute(
      'aria-label',
      this.getAttribute('alt') ?? 'A 3D model. Arrow keys turn it, plus and minus zoom.',
    );
  }

  #onKey(event: KeyboardEvent): void {
    const rig = this.#stage?.rig;
    if (rig === undefined || this.#actor === null || event.ctrlKey || event.metaKey || event.altKey) return;
    const turns: Record<string, readonly [number, number]> = {
      ArrowLeft: [-turnStep, 0],
      ArrowRight: [turnStep, 0],
      ArrowUp: [0, -turnStep],
      ArrowDown: [0, turnStep],
    };
    const turn = turns[event.key];
    if (turn !== undefined) rig.turn(...turn);
    else if (event.key === '+' || event.key === '=') rig.zoom(1 / zoomStep);
    else if (event.key === '-') rig.zoom(zoomStep);
    else if (event.key === 'Home') {
      rig.look('home', false);
      this.#stage?.fit(null, false);
    } else return;
    event.preventDefault();
  }
}
