#include "services/simulator/core/truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace roomwise::simulator {
namespace {

constexpr double kProbeRadius_m = 0.008;  // half a 2 cm board is still wider
constexpr int kProbes = 72;
constexpr double kProbeStep_rad = 2.0 * std::numbers::pi / kProbes;
constexpr double kPoleWidth_m = 0.25;
constexpr double kPoleRadius_m = 0.30;
constexpr double kSmallestHeight_m = 0.15;
constexpr double kGap_m = 0.10;  // a shelf board crossing an upright does not end it

// As landmark_observation_t names them.
constexpr int kConvex = 3;
constexpr int kConcave = 4;
constexpr int kPole = 5;

using Vector = Eigen::Vector2d;

double cross_product(const Vector& a, const Vector& b) { return a.x() * b.y() - a.y() * b.x(); }

bool contains(const Block& block, const Vector& p_m) {
  const auto& corners = block.corners_m;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector& a = corners[i];
    if (cross_product(corners[(i + 1) % corners.size()] - a, p_m - a) <= 0.0) return false;
  }
  return true;
}

bool contains(const Column& column, const Vector& p_m) {
  return (p_m - column.center_m).norm() < column.radius_m;
}

const std::array<Vector, kProbes>& probe_offsets_m() {
  static const auto offsets = [] {
    std::array<Vector, kProbes> made;
    for (int i = 0; i < kProbes; ++i) {
      const double angle_rad = (i + 0.5) * kProbeStep_rad;
      made[static_cast<std::size_t>(i)] =
          kProbeRadius_m * Vector(std::cos(angle_rad), std::sin(angle_rad));
    }
    return made;
  }();
  return offsets;
}

/// Which directions around a point one solid fills, and between which heights.
struct Sector {
  std::array<bool, kProbes> filled{};
  double low_m = 0.0;
  double high_m = 0.0;
};

template <class Body>
void add_sector(std::vector<Sector>& sectors, const Body& body, const Vector& p_m) {
  Sector sector{{}, body.low_m, body.high_m};
  for (std::size_t i = 0; i < kProbes; ++i) {
    sector.filled[i] = contains(body, p_m + probe_offsets_m()[i]);
  }
  if (std::find(sector.filled.begin(), sector.filled.end(), true) != sector.filled.end()) {
    sectors.push_back(sector);
  }
}

bool is_near(const Block& block, const Vector& p_m) {
  Eigen::AlignedBox2d bounds;
  for (const Vector& corner : block.corners_m) bounds.extend(corner);
  return bounds.squaredExteriorDistance(p_m) < kProbeRadius_m * kProbeRadius_m;
}

std::vector<Sector> sectors_around(const Scene& scene, const Vector& p_m) {
  std::vector<Sector> sectors;
  for (const Block& block : scene.blocks) {
    if (block.has_landmarks && is_near(block, p_m)) add_sector(sectors, block, p_m);
  }
  for (const Column& column : scene.columns) add_sector(sectors, column, p_m);
  return sectors;
}

/// Convex, concave or 0, from what is filled around a point.
int kind_of(const std::array<bool, kProbes>& filled) {
  int free = 0;
  int changes = 0;
  for (std::size_t i = 0; i < kProbes; ++i) {
    free += filled[i] ? 0 : 1;
    changes += filled[i] != filled[(i + 1) % kProbes] ? 1 : 0;
  }
  if (changes != 2) return 0;
  const double free_rad = free * kProbeStep_rad;
  const double degree_rad = std::numbers::pi / 180.0;
  if (free_rad >= 200.0 * degree_rad && free_rad <= 340.0 * degree_rad) return kConvex;
  return free_rad >= 20.0 * degree_rad && free_rad <= 160.0 * degree_rad ? kConcave : 0;
}

int kind_at(const std::vector<Sector>& sectors, double height_m) {
  std::array<bool, kProbes> filled{};
  for (const Sector& sector : sectors) {
    if (height_m <= sector.low_m || height_m >= sector.high_m) continue;
    for (std::size_t i = 0; i < kProbes; ++i) filled[i] = filled[i] || sector.filled[i];
  }
  return kind_of(filled);
}

struct Span {
  double low_m = 0.0;
  double high_m = 0.0;
  double height_m() const { return high_m - low_m; }
};

std::vector<double> heights_of(const std::vector<Sector>& sectors) {
  std::vector<double> heights_m{0.0};
  for (const Sector& sector : sectors) {
    heights_m.push_back(std::max(0.0, sector.low_m));
    heights_m.push_back(std::max(0.0, sector.high_m));
  }
  std::sort(heights_m.begin(), heights_m.end());
  return heights_m;
}

/// The tallest stretch over which the point is of `kind`, short gaps bridged.
std::optional<Span> tallest_span(const std::vector<Sector>& sectors, int kind) {
  const auto heights_m = heights_of(sectors);
  std::optional<Span> tallest;
  Span current{0.0, -1.0};
  for (std::size_t i = 0; i + 1 < heights_m.size(); ++i) {
    if (heights_m[i + 1] - heights_m[i] < 1e-9) continue;
    if (kind_at(sectors, (heights_m[i] + heights_m[i + 1]) / 2) != kind) continue;
    const bool goes_on = current.high_m >= 0.0 && heights_m[i] - current.high_m <= kGap_m;
    current = {goes_on ? current.low_m : heights_m[i], heights_m[i + 1]};
    if (!tallest || current.height_m() > tallest->height_m()) tallest = current;
  }
  if (tallest && tallest->height_m() < kSmallestHeight_m) return std::nullopt;
  return tallest;
}

double width_m(const Block& block) {
  double widest_m = 0.0;
  for (std::size_t i = 0; i < block.corners_m.size(); ++i) {
    const Vector& next = block.corners_m[(i + 1) % block.corners_m.size()];
    widest_m = std::max(widest_m, (next - block.corners_m[i]).norm());
  }
  return widest_m;
}

/// Thin and free-standing: seen as one pole, not as four edges.
bool is_pole(const Scene& scene, const Block& block) {
  if (!block.has_landmarks || width_m(block) >= kPoleWidth_m) return false;
  const double middle_m = (block.low_m + block.high_m) / 2;
  return std::all_of(block.corners_m.begin(), block.corners_m.end(), [&](const Vector& corner) {
    return kind_at(sectors_around(scene, corner), middle_m) == kConvex;
  });
}

Vector middle_m(const Block& block) {
  Vector sum_m = Vector::Zero();
  for (const Vector& corner : block.corners_m) sum_m += corner;
  return sum_m / static_cast<double>(block.corners_m.size());
}

class LandmarkList {
 public:
  void add(int kind, const Vector& p_m, const Span& span) {
    const auto same = [&](const SceneLandmark& known) {
      return known.kind == kind && (known.position_m - p_m).norm() < 1e-3;
    };
    if (span.height_m() < kSmallestHeight_m || std::any_of(list_.begin(), list_.end(), same)) {
      return;
    }
    list_.push_back({static_cast<int>(list_.size()), kind, p_m, span.low_m, span.high_m});
  }
  std::vector<SceneLandmark> take() { return std::move(list_); }

 private:
  std::vector<SceneLandmark> list_;
};

/// Where the outlines of two plans cross.
void append_crossings(const Block& one, const Block& other, std::vector<Vector>& crossings_m) {
  for (std::size_t i = 0; i < one.corners_m.size(); ++i) {
    const Vector& a = one.corners_m[i];
    const Vector ab = one.corners_m[(i + 1) % one.corners_m.size()] - a;
    for (std::size_t j = 0; j < other.corners_m.size(); ++j) {
      const Vector& c = other.corners_m[j];
      const Vector cd = other.corners_m[(j + 1) % other.corners_m.size()] - c;
      const double area = cross_product(ab, cd);
      if (std::abs(area) < 1e-12) continue;
      const double along_ab = cross_product(c - a, cd) / area;
      const double along_cd = cross_product(c - a, ab) / area;
      if (along_ab < 0.0 || along_ab > 1.0 || along_cd < 0.0 || along_cd > 1.0) continue;
      crossings_m.push_back(a + along_ab * ab);
    }
  }
}

/// Where a crease can be: corners of plans and crossings of their outlines.
std::vector<Vector> crease_places_m(const std::vector<const Block*>& blocks) {
  std::vector<Vector> places_m;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto& corners_m = blocks[i]->corners_m;
    places_m.insert(places_m.end(), corners_m.begin(), corners_m.end());
    for (std::size_t j = 0; j < i; ++j) append_crossings(*blocks[i], *blocks[j], places_m);
  }
  return places_m;
}

}  // namespace

std::vector<SceneLandmark> true_landmarks(const Scene& scene) {
  LandmarkList list;
  std::vector<const Block*> edged;
  for (const Block& block : scene.blocks) {
    if (is_pole(scene, block)) {
      list.add(kPole, middle_m(block), {std::max(0.0, block.low_m), block.high_m});
    } else if (block.has_landmarks) {
      edged.push_back(&block);
    }
  }
  for (const Column& column : scene.columns) {
    if (column.radius_m >= kPoleRadius_m) continue;
    list.add(kPole, column.center_m, {std::max(0.0, column.low_m), column.high_m});
  }
  for (const Vector& place_m : crease_places_m(edged)) {
    const auto sectors = sectors_around(scene, place_m);
    for (const int kind : {kConvex, kConcave}) {
      if (const auto span = tallest_span(sectors, kind)) list.add(kind, place_m, *span);
    }
  }
  return list.take();
}

}  // namespace roomwise::simulator
