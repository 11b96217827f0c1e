// Where parts meet: which pairs are looked at, and which of those are kept where very many parts overlap.
//
// Pairs whose boxes come near each other are found by a sweep along one axis. In ordinary models all of them are looked
// at and all that meet are kept. Two bounds hold for the rest, so that time and memory grow with the number of parts,
// not with its square:
//   * A pair is looked at when it is among the `partners` most of either part, by how far their boxes overlap. A floor
//     with a thousand things on it is most of each of them; only in a heap is a pair most of neither.
//   * Of a heap only what determines it is kept: a pair is left out when enough parts that both are joined to already
//     tie the one to the other. The pairs that overlap most come first.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/index.h"
#include "core/shape/attachment.h"
#include "core/shape/hexahedron.h"
#include "core/shape/part.h"

namespace parsel {

struct ContactLimits {
  std::size_t partners = 128;  ///< of one part, of which a bookcase for a library has 40
  /// Parts joined to both of two of one label, and of two labels, from which on the two need no joint of their own.
  /// Below 3, three cushions in a row on one seat against one back lose a joint; the shelves of a bookcase are joined
  /// to its sides and its back, so the second has to be above the number of shelves.
  std::size_t alike = 4, different = 24;
};

/// first < second.
using PartPair = std::pair<PartIndex, PartIndex>;
using Contacts = std::map<PartPair, ContactRegion>;

/// Of every part: the axes along which its contacts will be measured.
using MeasuredAxes = PartData<std::vector<Mat3>>;

/// Reduces the region of a pair to what the axes of both need.
void reduce(ContactRegion& region, const PartPair& pair, const MeasuredAxes& axes);

/// The regions in which parts meet; a second look, further away, only between what the first left apart. An empty
/// region: the one is inside the other and their surfaces do not meet. Regions are reduced to what `axes` need.
Contacts find_contacts(const PartData<PartMesh>& meshes, const PartData<Hexahedron>& boxes, const MeasuredAxes& axes,
                       const ContactLimits& limits = {});

}  // namespace parsel
