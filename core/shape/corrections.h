// Joints and mirror images that a person declares, whatever was found in the file.
//
// What is declared of two parts holds for their images as well, as what is found does: a leg that is not joined to the
// seat says so of its mirror image, and of all others in its row.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "core/shape/contacts.h"
#include "core/shape/part.h"
#include "core/shape/symmetry.h"

namespace parsel {

enum class CorrectionKind {
  joined,      ///< they touch, where their surfaces come nearest to each other, however far that is
  loose,       ///< … but are tied at the middle of where they touch alone: there either may turn and grow
  apart,       ///< they do not touch
  mirrored,    ///< they are mirror images, across the axis along which they are furthest apart
  unmirrored,  ///< they are not
};
std::string_view to_string(CorrectionKind kind);
std::optional<CorrectionKind> correction_kind(std::string_view text);
/// About a mirror image, not a joint.
bool is_of_mirrors(CorrectionKind kind);

struct Correction {
  CorrectionKind kind;
  /// As "node:3/1", or "node:3" for the only primitive of glTF node 3.
  std::array<std::string, 2> parts;
};
/// Of two about the same joint or mirror image the later one counts.
using Corrections = std::vector<Correction>;

/// [{"kind": "apart", "parts": ["node:3/0", "node:5/0"]}, …], untrusted. Error place is a JSON pointer.
Result<Corrections> corrections_from_json(const nlohmann::json& list);
/// The same as a file: format `parsel/corrections` v1, the list under "corrections".
Result<Corrections> corrections_from_file(const nlohmann::json& file);

/// A correction whose parts were found in the model.
struct Declared {
  CorrectionKind kind;
  PartPair pair;
};
/// Error: a part that the model does not have, its key being the place.
Result<std::vector<Declared>> declared(const Corrections& corrections, const PartData<PartMesh>& meshes);

/// One that cannot be: which parts, and why, a clause.
struct Undone {
  PartPair pair;
  std::string why;
};

/// Adds and removes mirror images. `boxes` are the parts' own, not yet aligned.
std::vector<Undone> correct_mirrors(Symmetries& symmetries, const PartData<Hexahedron>& boxes,
                                    const std::vector<Declared>& declared);

struct CorrectedContacts {
  std::set<PartPair> loose;
  std::set<PartPair> gaping;  ///< joined across a gap: they have no surface in common
};

/// Adds and removes contacts between real parts, whose `boxes` are aligned.
CorrectedContacts correct_contacts(Contacts& contacts, const PartData<PartMesh>& meshes,
                                   const PartData<Hexahedron>& boxes, const MeasuredAxes& axes,
                                   const Symmetries& symmetries, const std::vector<Declared>& declared);

/// An attachment of two boxes that is held at its middle alone.
FoundAttachment loosened(const FoundAttachment& found, const Hexahedron& a, const Hexahedron& b);

}  // namespace parsel
