#pragma once

#include <mrpt/math/TPoint2D.h>

#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

namespace mrpt_polyloc {

/// What all functions sampled at k directions phi_i = 2 pi i / k share: the directions, and the
/// Fourier transforms of length k (FFTW, single precision).
///
/// Plans are made once per k, estimated rather than measured so that results do not depend on
/// timing, and live until the program ends. All calls are thread-safe.
class CirclePlan {
 public:
  /// \throws InvalidParamsError unless k is even, at least 2, at most 2^20, and has no prime factor
  /// above 5: other lengths are slow to transform.
  static const CirclePlan& forSamples(std::size_t k);

  CirclePlan(const CirclePlan&) = delete;
  CirclePlan& operator=(const CirclePlan&) = delete;
  ~CirclePlan();

  std::size_t size() const { return directions_.size(); }
  std::size_t spectrumSize() const { return size() / 2 + 1; }
  /// (cos phi_i, sin phi_i)
  const std::vector<mrpt::math::TPoint2D>& directions() const { return directions_; }

  /// The spectrum k^(-1/2) Sum_i x_i exp(-2 pi sqrt(-1) i j / k), j = 0..k/2, of k samples. With
  /// this scale it is an isometry.
  std::vector<std::complex<float>> spectrum(const float* samples) const;
  /// The same, into spectrumSize() places.
  void spectrum(const float* samples, std::complex<float>* spectrum) const;

  /// The circular correlation c_s = Sum_i f_{i-s} g_i, s = 0..k-1, from two spectra.
  /// \returns k floats owned by the calling thread, valid until its next call of correlation()
  /// Rounding of c_s: at most correlationError() times ||f|| ||g||. O(k log k).
  const float* correlation(const std::complex<float>* f, const std::complex<float>* g) const;

  /// The sum of two correlations, at the cost of one transform. Valid as correlation() is; the
  /// errors add up.
  const float* correlation(const std::complex<float>* f, const std::complex<float>* g,
                           const std::complex<float>* f2, const std::complex<float>* g2) const;

  /// See correlation(): 4 epsilon log2(2 k).
  double correlationError() const;

 private:
  struct Transforms;
  explicit CirclePlan(std::size_t k);
  /// The samples of the spectrum that fill(float*) writes, not scaled, in the thread's buffer.
  template <class Fill>
  const float* transformedBack(Fill fill) const;

  std::vector<mrpt::math::TPoint2D> directions_;
  std::unique_ptr<Transforms> transforms_;
};

}  // namespace mrpt_polyloc
