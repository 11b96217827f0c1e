// The gallery's CAD programs: OpenSCAD texts of small things, each with variations made by hand, from which core/family
// finds the few sliders that mean something. The texts are compiled in: programs/<id>.scad, programs/<id>.variations.json.
#pragma once

#include <span>
#include <string_view>

namespace parsel {

struct GalleryProgram {
  std::string_view id;
  std::string_view scad;        ///< OpenSCAD, millimetres, front towards -y
  std::string_view variations;  ///< format parsel/variations v1, in the extended vocabulary
};

/// In the order of their ids.
std::span<const GalleryProgram> gallery_programs();

}  // namespace parsel
