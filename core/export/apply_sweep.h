// The slider as a glTF animation: the parameter runs from its minimum to its maximum and back.
//
// A node whose motion is a translation, rotation and axis-aligned scale gets tracks for these. Any other motion moves
// the 8 corners of its parts along curves; these span a space of low dimension (1 for an operator that is linear in its
// amount, 2 for a rotation), so a few morph targets span it as well, as vertices are linear in the corners. Tracks are
// piecewise linear, with as many keys as the error bound needs.
#pragma once

#include "core/export/apply_mesh.h"
#include "core/shape/shape.h"

namespace parsel::apply {

/// Largest distance between the animation and the program, at any vertex and time: 0.2 % of the half-diagonal.
inline constexpr double sweep_error = 0.002;

/// One node's part in the animation.
struct Track {
  std::size_t node = 0;
  std::vector<gltf::Placement> placements;   ///< of every sample; empty without TRS tracks
  std::vector<std::vector<double>> weights;  ///< of every sample, one a target; empty without morph targets
  std::vector<bool> visible;                 ///< of every sample; empty when always there
  std::vector<std::size_t> keys;             ///< samples that become key frames
};

/// Decides how each node moves, and gives slots the morph targets that they need. Nodes that stand still get no track;
/// those that cannot be animated (morph targets of their own) are named in a warning.
std::vector<Track> plan_tracks(const gltf::File& file, const gltf::Scene& scene, const Frame& frame,
                               std::vector<NodeEdit>& edits, std::vector<Warning>& warnings);

/// Adds the animation. `seconds` is the time from one end of the range to the other.
void write_animation(gltf::File& file, const std::string& name, double seconds, const std::vector<Track>& tracks);

/// Keys, first and last included, such that error(a, b, s) ≤ tolerance for every sample s between neighbouring keys.
template <class ErrorBetween>
std::vector<std::size_t> select_keys(std::size_t samples, double tolerance, const ErrorBetween& error) {
  std::vector<bool> chosen(samples, false);
  chosen.front() = chosen.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> pending{{0, samples - 1}};
  while (!pending.empty()) {
    const auto [a, b] = pending.back();
    pending.pop_back();
    std::size_t worst = a;
    double most = tolerance;
    for (std::size_t s = a + 1; s < b; ++s) {
      const double here = error(a, b, s);
      if (here > most) {
        most = here;
        worst = s;
      }
    }
    if (worst == a) continue;
    chosen[worst] = true;
    pending.emplace_back(a, worst);
    pending.emplace_back(worst, b);
  }
  std::vector<std::size_t> keys;
  for (std::size_t s = 0; s < samples; ++s) {
    if (chosen[s]) keys.push_back(s);
  }
  return keys;
}

}  // namespace parsel::apply
