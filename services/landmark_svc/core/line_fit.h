#pragma once

namespace roomwise::landmark {

/// Least-squares line y = mean_y + slope (x - mean_x), from weighted sums. Add points in a fixed
/// order and the result is the same to the bit.
class LineFit {
 public:
  void add(double x, double y, double weight = 1.0) {
    n_ += weight;
    x_ += weight * x;
    y_ += weight * y;
    xx_ += weight * x * x;
    xy_ += weight * x * y;
  }

  double count() const { return n_; }
  double mean_x() const { return n_ > 0.0 ? x_ / n_ : 0.0; }
  double mean_y() const { return n_ > 0.0 ? y_ / n_ : 0.0; }

  /// Mean square of x about its mean.
  double variance_x() const {
    if (n_ <= 0.0) return 0.0;
    const double variance = xx_ / n_ - mean_x() * mean_x();
    return variance > 0.0 ? variance : 0.0;
  }

  /// 0 where all points have one x.
  double slope() const {
    const double variance = variance_x();
    constexpr double kSmallest = 1e-12;
    return variance > kSmallest ? (xy_ / n_ - mean_x() * mean_y()) / variance : 0.0;
  }

  double at(double x) const { return mean_y() + slope() * (x - mean_x()); }

 private:
  double n_ = 0.0;
  double x_ = 0.0;
  double y_ = 0.0;
  double xx_ = 0.0;
  double xy_ = 0.0;
};

}  // namespace roomwise::landmark
