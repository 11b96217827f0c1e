// Saved work on a model whose parts were told apart: its file is split again, which gives the same file.
import type { ModelFiles } from '../scene/load';
import type { Saved } from '../share/saved';
import type { ModelCore } from './model_core';
import type { RunOptions } from './tasks';

/** The files as saved work had them: split, unless they are already. */
export async function splitAs(
  how: Saved['split'],
  files: ModelFiles,
  core: ModelCore,
  options: RunOptions,
): Promise<ModelFiles> {
  if (how === undefined || files.split !== undefined) return files;
  return (await core.split(files, how, options)).files;
}
