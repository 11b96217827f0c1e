// The models that come with the page: gallery/gallery.json and one .glb a model.
import * as v from 'valibot';
import type { EditInput } from './document';

const requestSchema = v.union([
  v.pipe(
    v.string(),
    v.transform((request) => ({ request, edit: null })),
  ),
  v.looseObject({ request: v.string(), edit: v.nullable(v.looseObject({ seed: v.array(v.unknown()) })) }),
]);
const gallerySchema = v.array(
  v.looseObject({ id: v.pipe(v.string(), v.regex(/^\w+$/)), title: v.string(), requests: v.array(requestSchema) }),
);

/** Something that can be asked of a model, with the edit that it means. */
export interface Suggestion {
  readonly request: string;
  readonly edit: EditInput | null;
}
export interface GalleryEntry {
  readonly id: string;
  readonly title: string;
  readonly suggestions: readonly Suggestion[];
}

let loading: Promise<readonly GalleryEntry[]> | null = null;

/** Empty when the page came without a gallery. */
export function loadGallery(): Promise<readonly GalleryEntry[]> {
  loading ??= fetch('./gallery/gallery.json')
    .then((response) => (response.ok ? response.json() : []))
    .then((json: unknown) =>
      v.parse(gallerySchema, json).map(({ id, title, requests }) => ({
        id,
        title,
        suggestions: requests.map(({ request, edit }) => ({
          request: request.replace(/\.$/, ''),
          edit: edit && ({ disabled: [], hints: {}, ...edit } as unknown as EditInput),
        })),
      })),
    )
    .catch(() => []);
  return loading;
}

const listSchema = v.array(v.strictObject({ id: v.pipe(v.string(), v.regex(/^\w+$/)), title: v.string() }));

/** The CAD programs that come with the page: gallery/programs.json. Empty when it came without. */
export const loadPrograms = () => loadList('programs');
/** Models of the gallery once more, without any name in them: gallery/nameless.json. */
export const loadNameless = () => loadList('nameless');

async function loadList(name: string): Promise<v.InferOutput<typeof listSchema>> {
  try {
    const response = await fetch(`./gallery/${name}.json`);
    return response.ok ? v.parse(listSchema, await response.json()) : [];
  } catch {
    return [];
  }
}

const program = '_program';

/** What of the gallery is a CAD program: its text, and what it is opened together with. */
export const programUrls = (id: string): readonly string[] | null =>
  id.endsWith(program)
    ? ['scad', 'variations.json'].map((kind) => `./gallery/programs/${id.slice(0, -program.length)}.${kind}`)
    : null;

/** Of a model; of a program, what it makes. */
export const galleryUrl = (id: string): string => `./gallery/${id}.glb`;
