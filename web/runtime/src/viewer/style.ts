// The element's own style, as a constructed sheet: a policy that forbids inline styles does not forbid this.

export const style = /* css */ `
:host {
  color-scheme: light dark;
  display: flex;
  flex-direction: column;
  position: relative;
  min-height: 240px;
  overflow: hidden;
  contain: content;
  --parsel-text: light-dark(#1d1f22, #eceded);
  --parsel-quiet: light-dark(#5a5f66, #a4a9b0);
  --parsel-ground: light-dark(#f3f3f0, #17181a);
  --parsel-panel: light-dark(#ffffff, #212326);
  --parsel-line: light-dark(#dcdcd6, #3a3d42);
  --parsel-accent: light-dark(#2361cf, #7fabff);
  --parsel-broken: light-dark(#8a4f00, #f0b45a);
  background: var(--parsel-ground);
  color: var(--parsel-text);
  font: 14px / 1.45 system-ui, sans-serif;
}
:host([hidden]) { display: none; }
:host([theme="light"]) { color-scheme: light; }
:host([theme="dark"]) { color-scheme: dark; }

.stage { position: relative; flex: 1; min-height: 160px; }
canvas { position: absolute; inset: 0; width: 100%; height: 100%; display: block; touch-action: none; }
:focus-visible { outline: 2px solid var(--parsel-accent); outline-offset: -2px; }

.controls {
  max-height: 45%;
  overflow: auto;
  background: var(--parsel-panel);
  border-top: 1px solid var(--parsel-line);
}
ul { list-style: none; margin: 0; padding: 10px 16px; display: grid; gap: 10px; }
ul:empty { display: none; }
li { display: grid; grid-template-columns: 1fr auto auto; gap: 0 8px; align-items: center; }
label { overflow-wrap: anywhere; }
output { color: var(--parsel-quiet); font-variant-numeric: tabular-nums; }
input { grid-column: 1 / -1; width: 100%; min-height: 24px; margin: 0; accent-color: var(--parsel-accent); }
button {
  min-width: 24px;
  min-height: 24px;
  padding: 0 8px;
  font: inherit;
  color: inherit;
  background: none;
  border: 1px solid var(--parsel-line);
  border-radius: 4px;
  cursor: pointer;
}
button:disabled { opacity: 0.45; cursor: default; }

.message {
  position: absolute;
  inset: 0;
  margin: auto;
  width: fit-content;
  height: fit-content;
  max-width: min(90%, 56ch);
  padding: 12px 16px;
  border-radius: 8px;
  border: 1px solid var(--parsel-line);
  background: var(--parsel-panel);
  overflow-wrap: anywhere;
}
.message:empty { display: none; }
.message.error { color: var(--parsel-broken); }
@media (prefers-reduced-motion: no-preference) {
  .message.loading { animation: appear 0.3s 0.3s both; }
}
@keyframes appear { from { opacity: 0; } }
`;
