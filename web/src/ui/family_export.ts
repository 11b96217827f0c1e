// A family as files that work without this page: an OpenSCAD program, and the parameter sets of its Customizer.

import { models } from '../session/core';
import { plainName } from '../session/download_names';
import { areThere } from '../session/family_state';
import { family as actions, document, run } from '../session/session';
import { t } from '../texts/texts';
import { download } from './actions';

async function text() {
  const core = models.peek();
  const { model, family } = document.peek();
  if (core === null || model === null || family === undefined) return null;
  const made = await run(t`Writing the program`, () =>
    core.familyText({
      ...family.asked,
      choices: { ...family.choices },
      setting: [...actions.settingNow(family)],
      with: family.found.family.optional.map(({ parts }) => areThere(document.peek(), parts)),
    }),
  );
  return made === null ? null : { ...made, name: plainName(model.shape.name) };
}

/** The program with its sliders as variables that the Customizer shows, beginning where the model stands. */
export async function exportScad(): Promise<void> {
  const made = await text();
  if (made) download(`${made.name}.family.scad`, new Blob([made.scad], { type: 'text/plain' }));
}

/** One set a variation. OpenSCAD finds them by the program's name. */
export async function exportSets(): Promise<void> {
  const made = await text();
  const json = JSON.stringify(made?.sets, null, 1);
  if (made) download(`${made.name}.family.json`, new Blob([json], { type: 'application/json' }));
}
