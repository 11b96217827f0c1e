#include "core/split/pieces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace parsel::split {

std::vector<Piece> pieces_of(const PartMesh& mesh, const Components& numbering) {
  constexpr double far = std::numeric_limits<double>::infinity();
  std::vector<Piece> pieces(numbering.count);
  for (Piece& piece : pieces) {
    piece.low.setConstant(far);
    piece.high.setConstant(-far);
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Piece& piece = pieces[numbering.of[t]];
    piece.triangles.push_back(t);
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 &from = mesh.positions[a], u = mesh.positions[b] - from, w = mesh.positions[c] - from;
    piece.area += u.cross(w).norm() / 2;
    for (const std::uint32_t v : mesh.triangles[t]) {
      piece.low = piece.low.cwiseMin(mesh.positions[v]);
      piece.high = piece.high.cwiseMax(mesh.positions[v]);
    }
  }
  return pieces;
}

double small_below(double fine) {
  return fine >= 1 ? 0 : 0.4 * std::pow(0.05, 2 * std::max(fine, 0.0));
}

std::size_t join_small(std::vector<Piece>& pieces, double below, std::size_t most) {
  const auto is_small = [&](const Piece& piece) { return piece.diagonal() < below; };
  const auto count = static_cast<std::size_t>(std::count_if(pieces.begin(), pieces.end(), is_small));
  if (count == pieces.size() || pieces.size() - count > most) return 0;
  std::vector<Piece> large, small;
  for (Piece& piece : pieces) (is_small(piece) ? small : large).push_back(std::move(piece));
  // Where each goes is found before anything is joined, so that their order does not matter.
  struct Box {
    Vec3 low, high;
    double size;
  };
  std::vector<Box> boxes;
  for (const Piece& piece : large) boxes.push_back({piece.low, piece.high, piece.diagonal()});
  for (const Piece& piece : small) {
    std::size_t host = 0;
    double least = std::numeric_limits<double>::infinity(), size = least;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Vec3 gap = (boxes[i].low - piece.high).cwiseMax(piece.low - boxes[i].high).cwiseMax(0.0);
      // Within a tenth of its own size it touches.
      const double distance = std::max(gap.norm() - 0.1 * piece.diagonal(), 0.0);
      if (distance > least || (distance == least && boxes[i].size >= size)) continue;
      host = i, least = distance, size = boxes[i].size;
    }
    Piece& into = large[host];
    into.triangles.insert(into.triangles.end(), piece.triangles.begin(), piece.triangles.end());
    into.low = into.low.cwiseMin(piece.low);
    into.high = into.high.cwiseMax(piece.high);
    into.area += piece.area;
  }
  for (Piece& piece : large) std::sort(piece.triangles.begin(), piece.triangles.end());
  pieces = std::move(large);
  return small.size();
}

}  // namespace parsel::split
