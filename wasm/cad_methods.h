// What the page can ask about CAD programs and their families. No state: every call brings its program.
#pragma once

#include "wasm/methods.h"

namespace parsel::wasm {

/// name; buffers = the OpenSCAD text. Answers {cad: parsel/cad, warnings: [text], parts: [{id, name, stem}]} and the
/// GLB.
Result<Output> open_cad(const Input& input);

/// cad: parsel/cad; variations: parsel/variations, or null for none; choices: {constraint id: "forced"|"off"}. Answers
/// the family, its program (lengths in half-diagonals of the drawn model, `scale` units each), what the sliders are
/// bounded by, and one GLB a variation with the parts that it has.
Result<Output> find_family(const Input& input);

/// As find_family, and setting: one value a slider, in the model's unit; with: one true or false an optional group.
/// Answers the OpenSCAD text that begins there, and the Customizer's parameter sets.
Result<Output> family_text(const Input& input);

/// cad; task: kinds or variation; kind: which one, for variation, else empty; count: of kinds, 0 as many as usual.
/// Answers {prompt: {task, text, hash, version}, words, schema}.
Result<Output> cad_prompt(const Input& input);

/// cad, task and kind as for cad_prompt; texts: the replies. Answers what they mean, counted:
/// core/infer/variation_reply.h.
Result<Output> read_cad_replies(const Input& input);

/// The gallery's CAD programs: [{id}], and their texts and variations as buffers, two each.
Result<Output> cad_gallery(const Input& input);

}  // namespace parsel::wasm
