// The constructive parameters of a CAD model (ReparamCAD §3.1) as one vector: of every part its centre, its size along
// the global axes and, for a cone, its top.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "core/cad/model.h"

namespace parsel::family {

/// `paper`: ReparamCAD's own features; a cone's top is a share of its base, which no linear constraint can reach.
/// `extended`: besides, the planes that bound round parts, and tops as lengths.
enum class Vocabulary { paper, extended };
std::string_view to_string(Vocabulary vocabulary);

enum class Quantity { centre, size, top };

struct Parameter {
  std::size_t part = 0;
  Quantity quantity = Quantity::centre;
  int axis = 0;      ///< centre, size
  std::string name;  ///< "seat.cx", "seat.sy", "neck.top" ("neck.r_top" for a share: radius by base diameter)
};

using Values = Eigen::VectorXd;

struct Layout {
  Vocabulary vocabulary = Vocabulary::paper;
  std::vector<Parameter> parameters;
  std::vector<std::size_t> first;  ///< by part: its centre x; centre y, z, size x, y, z and maybe top follow

  std::size_t size() const { return parameters.size(); }
  std::size_t centre(std::size_t part, int axis) const { return first[part] + static_cast<std::size_t>(axis); }
  std::size_t extent(std::size_t part, int axis) const { return first[part] + 3 + static_cast<std::size_t>(axis); }
  std::size_t top(std::size_t part) const { return first[part] + 6; }
  /// Index of a parameter by name; size() when there is none.
  std::size_t find(std::string_view name) const;
};

Layout layout_of(const cad::Model& model, Vocabulary vocabulary);
Values values_of(const Layout& layout, const cad::Model& model);
/// The model with other numbers. Places in the source stay.
cad::Model with_values(const Layout& layout, const cad::Model& model, const Values& values);

/// Half the diagonal of the box around all parts: the length that tolerances are relative to.
double half_diagonal(const cad::Model& model);

}  // namespace parsel::family
