#include "core/shape/corrections.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/shape/alike.h"

namespace parsel {

namespace {

/// Corners of declared mirror images may be this far from where the plane puts them, in the normalised frame, whose
/// diagonal is 2: they become exact images. More: a part's mesh no longer fits the box it is edited in.
constexpr double declared_image = 0.1;
/// Declared pairs whose middle is this near a plane that others mirror about share that plane.
constexpr double shared_plane = 0.02;
/// No two parts of a model are further apart, normalised.
constexpr double furthest = 4;

PartPair ordered(PartIndex a, PartIndex b) {
  return {std::min(a, b), std::max(a, b)};
}

Vec3 centre_of(const Hexahedron& box) {
  return box.point(Vec3::Zero());
}

/// Which pairs of parts are what two parts are.
class Images {
 public:
  Images(const Symmetries& symmetries, const PartData<Hexahedron>& boxes) : symmetries_(symmetries), boxes_(boxes) {
    for (const MirrorPair& m : symmetries.mirrors) {
      auto& image = planes_[{m.axis, m.offset}];
      image[m.a] = m.b;
      image[m.b] = m.a;
    }
    for (const SymmetryGroup& group : symmetries.groups) {
      for (const PartIndex p : group.parts) group_of_[p] = &group;
    }
  }

  /// The pair itself among them.
  std::set<PartPair> of(const PartPair& pair) const {
    std::vector<PartPair> found = {pair};
    std::set<PartPair> all = {pair};
    const auto add = [&](PartIndex a, PartIndex b) {
      if (a != b && all.insert(ordered(a, b)).second) found.push_back(ordered(a, b));
    };
    for (std::size_t at = 0; at < found.size(); ++at) {
      const auto [a, b] = found[at];
      for (const auto& [plane, image] : planes_) {
        const auto ia = image_of(a, plane, image), ib = image_of(b, plane, image);
        if (ia && ib) add(*ia, *ib);
      }
      for (const PartIndex p : instances(a, b)) {
        for (const PartIndex q : instances(b, a)) add(p, q);
      }
    }
    return all;
  }

  const SymmetryGroup* group_of(PartIndex p) const {
    const auto found = group_of_.find(p);
    return found == group_of_.end() ? nullptr : found->second;
  }

 private:
  using Plane = std::pair<int, double>;

  std::optional<PartIndex> image_of(PartIndex p, const Plane& plane,
                                    const std::map<PartIndex, PartIndex>& image) const {
    const auto found = image.find(p);
    if (found != image.end()) return found->second;
    return is_own_image(boxes_[p], plane.first, plane.second) ? std::optional(p) : std::nullopt;
  }

  /// All that stand in a row or ring with p; p alone where the other stands in the same one.
  std::vector<PartIndex> instances(PartIndex p, PartIndex other) const {
    const SymmetryGroup* group = group_of(p);
    return group == nullptr || group == group_of(other) ? std::vector{p} : group->parts;
  }

  const Symmetries& symmetries_;
  const PartData<Hexahedron>& boxes_;
  std::map<Plane, std::map<PartIndex, PartIndex>> planes_;
  std::map<PartIndex, const SymmetryGroup*> group_of_;
};

/// Largest distance of a corner of either box from the nearest of the other's: their axes may be numbered otherwise.
double apart(const Hexahedron& a, const Hexahedron& b) {
  double most = 0;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (int k = 0; k < 8; ++k) {
      const auto off = (to->corners.rowwise() - from->corners.row(k)).rowwise().norm();
      most = std::max(most, off.minCoeff());
    }
  }
  return most;
}

class MirrorCorrections {
 public:
  MirrorCorrections(Symmetries& symmetries, const PartData<Hexahedron>& boxes)
      : symmetries_(symmetries), boxes_(boxes) {}

  void remove(const PartPair& pair) {
    const std::set<PartPair> images = Images(symmetries_, boxes_).of(pair);
    std::set<int> axes;
    for (const MirrorPair& m : symmetries_.mirrors) {
      if (ordered(m.a, m.b) == pair) axes.insert(m.axis);
    }
    std::erase_if(symmetries_.mirrors,
                  [&](const MirrorPair& m) { return axes.count(m.axis) > 0 && images.count(ordered(m.a, m.b)) > 0; });
  }

  /// Why it cannot be; empty when it is done.
  std::string add(const PartPair& pair) {
    const Images images(symmetries_, boxes_);
    const SymmetryGroup *first = images.group_of(pair.first), *second = images.group_of(pair.second);
    if (first != nullptr && first == second) return "they stand in one row, which ties them already";
    const Vec3 along = centre_of(boxes_[pair.second]) - centre_of(boxes_[pair.first]);
    int axis = 0;
    along.cwiseAbs().maxCoeff(&axis);
    std::vector<MirrorPair> pairs;
    if (first == nullptr || second == nullptr) {
      pairs = {about_middle(pair, axis)};
      for (const PartPair& image : images.of(pair)) {
        const bool is_free = images.group_of(image.first) == nullptr && images.group_of(image.second) == nullptr;
        if (image != pair && is_free && off(about_middle(image, axis)) <= declared_image)
          pairs.push_back(about_middle(image, axis));
      }
    } else if (first->parts.size() != second->parts.size()) {
      return "the rows that they stand in have unequal numbers of parts";
    } else {
      const double offset = about_middle(pair, axis).offset;
      for (const PartIndex p : first->parts) {
        const PartPair own = ordered(p, nearest(second->parts, mirrored(boxes_[p], axis, offset)));
        pairs.push_back({own.first, own.second, axis, offset});
      }
    }
    for (const MirrorPair& m : pairs) {
      if (off(m) <= declared_image) continue;
      const int percent = std::max(1, static_cast<int>(std::lround(50 * off(m))));  // of the diagonal, which is 2
      return "they differ too much: the image of the one is off the other by " + std::to_string(percent) +
             " % of the model's diagonal";
    }
    for (const MirrorPair& m : pairs) {
      const bool is_known = std::any_of(symmetries_.mirrors.begin(), symmetries_.mirrors.end(), [&](const auto& other) {
        return other.a == m.a && other.b == m.b && other.axis == m.axis;
      });
      if (!is_known) symmetries_.mirrors.push_back(m);
    }
    return {};
  }

 private:
  MirrorPair about_middle(const PartPair& pair, int axis) const {
    const double middle = (centre_of(boxes_[pair.first]) + centre_of(boxes_[pair.second]))[axis] / 2;
    return {pair.first, pair.second, axis, plane_for(axis, middle)};
  }

  double off(const MirrorPair& m) const { return apart(mirrored(boxes_[m.a], m.axis, m.offset), boxes_[m.b]); }

  /// A plane that others mirror about, or the middle of the model, where it is near; else the pair's own.
  double plane_for(int axis, double middle) const {
    double best = std::abs(middle) <= shared_plane ? 0 : middle, off = shared_plane;
    for (const MirrorPair& m : symmetries_.mirrors) {
      if (m.axis != axis || std::abs(m.offset - middle) > off) continue;
      off = std::abs(m.offset - middle);
      best = m.offset;
    }
    return best;
  }

  PartIndex nearest(const std::vector<PartIndex>& parts, const Hexahedron& image) const {
    return *std::min_element(parts.begin(), parts.end(), [&](PartIndex p, PartIndex q) {
      const auto off = [&](PartIndex part) { return (centre_of(boxes_[part]) - centre_of(image)).norm(); };
      return off(p) < off(q);
    });
  }

  Symmetries& symmetries_;
  const PartData<Hexahedron>& boxes_;
};

/// Where two parts come nearest to each other: how far they are apart there, to within contact_distance, and the region.
std::pair<double, ContactRegion> nearest_region(const PartMesh& a, const Hexahedron& box_a, const PartMesh& b,
                                                const Hexahedron& box_b) {
  double near = 0, far = contact_distance;
  ContactRegion found = contact_region(a, box_a, b, box_b, far);
  while (found.empty() && far < furthest) {
    near = far;
    far *= 2;
    found = contact_region(a, box_a, b, box_b, far);
  }
  while (far - near > contact_distance) {
    const double middle = (near + far) / 2;
    ContactRegion region = contact_region(a, box_a, b, box_b, middle);
    if (region.empty()) {
      near = middle;
    } else {
      far = middle;
      found = std::move(region);
    }
  }
  return {far, std::move(found)};
}

/// A region across a gap, put onto the plane half way: as thick as the gap is, it would tie what lies behind it.
ContactRegion flattened(const ContactRegion& region, const Hexahedron& a, const Hexahedron& b) {
  Vec3 across = Vec3::UnitY();
  double low = 0, high = 0, widest = -furthest;
  for (const Mat3& axes : {a.axes, b.axes}) {
    for (int i = 0; i < 3; ++i) {
      for (const double sign : {1.0, -1.0}) {
        const Vec3 axis = sign * axes.row(i).transpose();
        const double end = (a.corners * axis).maxCoeff(), start = (b.corners * axis).minCoeff();
        if (start - end <= widest) continue;
        widest = start - end;
        across = axis;
        low = end;
        high = start;
      }
    }
  }
  const double middle = (low + high) / 2;
  ContactRegion flat;
  for (const Vec3& v : region.vertices) flat.add(v + (middle - across.dot(v)) * across);
  flat.area = region.area;
  flat.moment = region.moment + (middle * region.area - across.dot(region.moment)) * across;
  return flat;
}

}  // namespace

std::vector<Undone> correct_mirrors(Symmetries& symmetries, const PartData<Hexahedron>& boxes,
                                    const std::vector<Declared>& declared) {
  MirrorCorrections corrections(symmetries, boxes);
  std::vector<Undone> undone;
  for (const auto& [kind, pair] : declared) {
    if (kind == CorrectionKind::unmirrored) corrections.remove(pair);
    if (kind != CorrectionKind::mirrored) continue;
    if (std::string why = corrections.add(pair); !why.empty()) undone.push_back({pair, std::move(why)});
  }
  return undone;
}

CorrectedContacts correct_contacts(Contacts& contacts, const PartData<PartMesh>& meshes,
                                   const PartData<Hexahedron>& boxes, const MeasuredAxes& axes,
                                   const Symmetries& symmetries, const std::vector<Declared>& declared) {
  CorrectedContacts corrected;
  const Images images(symmetries, boxes);
  const auto add = [&](const PartPair& pair, double most) {
    auto [distance, region] =
        nearest_region(meshes[pair.first], boxes[pair.first], meshes[pair.second], boxes[pair.second]);
    if (region.empty() || distance > most) return most;
    if (distance > far_contact_distance) region = flattened(region, boxes[pair.first], boxes[pair.second]);
    reduce(region, pair, axes);
    contacts[pair] = std::move(region);
    if (distance > far_contact_distance) corrected.gaping.insert(pair);
    return distance;
  };
  for (const auto& [kind, pair] : declared) {
    if (is_of_mirrors(kind)) continue;
    const std::set<PartPair> all = images.of(pair);
    if (kind != CorrectionKind::apart && contacts.count(pair) == 0) {
      const double distance = add(pair, furthest);
      for (const PartPair& image : all) {
        if (contacts.count(image) == 0) add(image, distance + twin_contact_distance);
      }
    }
    for (const PartPair& image : all) {
      if (kind == CorrectionKind::apart) contacts.erase(image), corrected.gaping.erase(image);
      if (kind == CorrectionKind::loose && contacts.count(image) > 0) {
        corrected.loose.insert(image);
      } else {
        corrected.loose.erase(image);
      }
    }
  }
  return corrected;
}

FoundAttachment loosened(const FoundAttachment& found, const Hexahedron& a, const Hexahedron& b) {
  const std::optional<ContactPatch>& patch = found.attachment.patch;
  Vec3 middle = patch ? patch->centre : Vec3::Zero();
  if (!patch) {
    for (const Vec3& point : found.attachment.points) middle += point;
    middle /= static_cast<double>(found.attachment.points.size());
  }
  return {0, {{middle}, {local_on_features(a, middle)}, {local_on_features(b, middle)}, patch}};
}

}  // namespace parsel
