// The SLAM filter beside MRPT's CRangeBearingKFSLAM2D on the same simulated robot, and its
// covariance sweep beside the memory it runs in.
//
// landmarks_N/.../frame   one step of odometry and one frame of the few landmarks in a 57 degree
//                         view, identities known, N landmarks in the map
// sweep_N/roomwise/pass   the upper half of the covariance of N landmarks, read and written once
//                         for one landmark seen (4 terms); bytes counted once in, once out
// sweep_N/in_place/pass   as many bytes in one row, in and out with next to no arithmetic: what the
//                         cache gives, where there is one as large
// memory/in_place/pass    the same in a buffer beyond any cache: what the memory gives
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "common/geometry/pose2.h"
#include "common/multiversion.h"
#include "services/ekf_svc/core/slam.h"

#ifdef ROOMWISE_HAVE_MRPT
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/slam/CRangeBearingKFSLAM2D.h>
#endif

namespace roomwise::ekf {
namespace {

constexpr double kHalfView_rad = 28.5 * std::numbers::pi / 180.0;
constexpr double kRangeMax_m = 3.8;
constexpr double kStep_m = 0.05;
constexpr double kTurn_rad = 0.02;
constexpr double kRangeSigma_m = 0.02;
constexpr double kBearingSigma_rad = 0.005;

struct Seen {
  int identity;
  double range_m;
  double bearing_rad;
};

/// A robot going round among landmarks 1 m apart. The first frame shows all of them.
class Scene {
 public:
  explicit Scene(int landmarks) {
    const int side = static_cast<int>(std::ceil(std::sqrt(landmarks)));
    for (int i = 0; i < landmarks; ++i) {
      landmarks_.emplace_back(i % side - side / 2 + 0.25, i / side - side / 2 + 0.25);
    }
  }
  std::vector<Seen> everything() { return look(std::numbers::pi, 1e9); }
  std::vector<Seen> view() { return look(kHalfView_rad, kRangeMax_m); }
  void drive() { truth_ = moved(truth_, step()); }
  static MotionIncrement step() {
    MotionIncrement motion;
    const Eigen::Matrix2d covariance = Eigen::Vector2d(1e-6, 1e-5).asDiagonal();
    motion.append(arc_step(kStep_m, kTurn_rad, covariance));
    return motion;
  }

 private:
  std::vector<Seen> look(double half_view_rad, double range_max_m) {
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < landmarks_.size(); ++i) {
      const Eigen::Vector2d p = transform(inverse(truth_), landmarks_[i]);
      const double bearing = std::atan2(p.y(), p.x());
      if (p.norm() > range_max_m || std::abs(bearing) > half_view_rad) continue;
      seen.push_back({static_cast<int>(i), p.norm() + kRangeSigma_m * noise_(engine_),
                      bearing + kBearingSigma_rad * noise_(engine_)});
    }
    return seen;
  }

  std::vector<Eigen::Vector2d> landmarks_;
  Pose2 truth_;
  std::mt19937_64 engine_{1};
  std::normal_distribution<double> noise_;
};

class Roomwise {
 public:
  void use(bool moves, const std::vector<Seen>& seen) {
    sightings_.clear();
    for (const Seen& s : seen) {
      Sighting sighting;
      sighting.identity = s.identity;
      sighting.polar.range_m = s.range_m;
      sighting.polar.bearing_rad = s.bearing_rad;
      sighting.polar.covariance(0, 0) = kRangeSigma_m * kRangeSigma_m;
      sighting.polar.covariance(1, 1) = kBearingSigma_rad * kBearingSigma_rad;
      sightings_.push_back(sighting);
    }
    verdicts_.resize(sightings_.size());
    if (moves) slam_.predict(Scene::step());
    slam_.process(sightings_, true, verdicts_);
  }
  std::size_t landmarks() const { return slam_.filter().landmark_count(); }

 private:
  Slam slam_{EkfParams{}};
  std::vector<Sighting> sightings_;
  std::vector<Verdict> verdicts_;
};

#ifdef ROOMWISE_HAVE_MRPT
template <mrpt::bayes::TKFMethod kMethod>
class Mrpt {
 public:
  Mrpt() {
    slam_.KF_options.method = kMethod;
    slam_.options.std_sensor_range = static_cast<float>(kRangeSigma_m);
    slam_.options.std_sensor_yaw = static_cast<float>(kBearingSigma_rad);
  }
  void use(bool moves, const std::vector<Seen>& seen) {
    auto observation = mrpt::obs::CObservationBearingRange::Create();
    observation->fieldOfView_yaw = static_cast<float>(2.0 * kHalfView_rad);
    observation->maxSensorDistance = static_cast<float>(kRangeMax_m);
    for (const Seen& s : seen) {
      auto& measured = observation->sensedData.emplace_back();
      measured.landmarkID = s.identity;
      measured.range = static_cast<float>(s.range_m);
      measured.yaw = static_cast<float>(s.bearing_rad);
      measured.pitch = 0.0F;
    }
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(observation);
    auto actions = motion(moves);
    slam_.processActionObservation(actions, frame);
  }
  std::size_t landmarks() const { return slam_.getNumberOfLandmarksInTheMap(); }

 private:
  static mrpt::obs::CActionCollection::Ptr motion(bool moves) {
    const MotionIncrement step = moves ? Scene::step() : MotionIncrement{};
    mrpt::obs::CActionRobotMovement2D action;
    mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
    model.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
    action.computeFromOdometry(
        mrpt::poses::CPose2D(step.translation_m.x(), step.translation_m.y(), step.turn_rad), model);
    auto actions = mrpt::obs::CActionCollection::Create();
    actions->insert(action);
    return actions;
  }
  mrpt::slam::CRangeBearingKFSLAM2D slam_;
};
#endif

template <class Filter>
void frames(benchmark::State& state, int landmarks) {
  Scene scene(landmarks);
  Filter filter;
  filter.use(false, scene.everything());
  std::size_t seen = 0;
  for (auto _ : state) {
    state.PauseTiming();
    scene.drive();
    const std::vector<Seen> view = scene.view();
    seen += view.size();
    state.ResumeTiming();
    filter.use(true, view);
  }
  if (filter.landmarks() != static_cast<std::size_t>(landmarks)) state.SkipWithError("map differs");
  state.counters["seen_per_frame"] =
      benchmark::Counter(static_cast<double>(seen), benchmark::Counter::kAvgIterations);
}

constexpr std::size_t kBeyondCaches = std::size_t{32} << 20;  // doubles: 256 MiB

std::size_t upper_half_size(std::size_t n) { return n * (n + 1) / 2; }

/// Counts what a pass over `size` doubles moves: every one of them in and out.
void count_bytes(benchmark::State& state, std::size_t size) {
  state.counters["GB_per_s"] = benchmark::Counter(1e-9 * 16.0 * static_cast<double>(size),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

void sweep(benchmark::State& state, std::size_t n) {
  CovarianceStore store(n);
  AlignedBuffer vectors(4 * store.stride());
  std::vector<SweepTerm> terms;
  for (std::size_t k = 0; k < 4; ++k) {
    double* vector = vectors.data() + k * store.stride();
    for (std::size_t i = 0; i < n; ++i) vector[i] = 1e-3 * static_cast<double>((i + k) % 7);
    terms.push_back({vector, vector, k % 2 == 0 ? 1.0 : -1.0});
  }
  sweep_upper(store.data(), store.stride(), n, terms);  // the system hands out the pages
  for (auto _ : state) sweep_upper(store.data(), store.stride(), n, terms);
  count_bytes(state, upper_half_size(n));
}

ROOMWISE_MULTIVERSION
void scale(double* values, std::size_t size, double by) {
  for (std::size_t i = 0; i < size; ++i) values[i] *= by;
}

void scale_in_place(benchmark::State& state, std::size_t size) {
  AlignedBuffer values(size);
  scale(values.data(), size, 0.0);
  for (auto _ : state) {
    scale(values.data(), size, 1.0000001);
    benchmark::ClobberMemory();
  }
  count_bytes(state, size);
}

void add_frames(int landmarks) {
  const std::string subject = "landmarks_" + std::to_string(landmarks);
  const auto add = [&](const char* who, auto run) {
    benchmark::RegisterBenchmark((subject + "/" + who + "/frame").c_str(), run)
        ->Unit(benchmark::kMillisecond);
  };
  add("roomwise", [=](benchmark::State& s) { frames<Roomwise>(s, landmarks); });
#ifdef ROOMWISE_HAVE_MRPT
  using mrpt::bayes::kfEKFAlaDavison;
  using mrpt::bayes::kfEKFNaive;
  add("mrpt_naive", [=](benchmark::State& s) { frames<Mrpt<kfEKFNaive>>(s, landmarks); });
  add("mrpt_davison", [=](benchmark::State& s) { frames<Mrpt<kfEKFAlaDavison>>(s, landmarks); });
#endif
}

void add_sweep(std::size_t landmarks) {
  const std::string subject = "sweep_" + std::to_string(landmarks);
  const std::size_t n = SlamFilter::landmark_index(landmarks);
  benchmark::RegisterBenchmark((subject + "/in_place/pass").c_str(), [n](auto& state) {
    scale_in_place(state, upper_half_size(n));
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark((subject + "/roomwise/pass").c_str(), [n](auto& state) {
    sweep(state, n);
  })->Unit(benchmark::kMillisecond);
}

void add_memory() {
  benchmark::RegisterBenchmark("memory/in_place/pass", [](auto& state) {
    scale_in_place(state, kBeyondCaches);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace roomwise::ekf

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
#ifndef ROOMWISE_HAVE_MRPT
  std::fprintf(stderr, "MRPT is not installed (scripts/setup --peers): no comparison with it\n");
#endif
  for (const int landmarks : {30, 100, 300, 1000}) roomwise::ekf::add_frames(landmarks);
  for (const std::size_t landmarks : {1000U, 2000U}) roomwise::ekf::add_sweep(landmarks);
  roomwise::ekf::add_memory();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
