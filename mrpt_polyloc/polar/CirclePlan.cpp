#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/polar/CirclePlan.h>

#include <algorithm>
#include <cmath>
#include <fftw3.h>
#include <limits>
#include <map>
#include <mutex>
#include <new>
#include <string>

namespace mrpt_polyloc {

namespace {

struct FreeFftw {
  void operator()(void* memory) const { fftwf_free(memory); }
};

/// Memory aligned as FFTW's vector code wants it, as long as has ever been asked of this thread.
struct Buffers {
  void reserve(std::size_t k) {
    if (k <= capacity) return;
    samples.reset(static_cast<float*>(fftwf_malloc(sizeof(float) * k)));
    spectrum.reset(static_cast<float*>(fftwf_malloc(sizeof(float) * 2 * (k / 2 + 1))));
    capacity = samples && spectrum ? k : 0;
    if (capacity == 0) throw std::bad_alloc();
  }

  std::unique_ptr<float, FreeFftw> samples;
  std::unique_ptr<float, FreeFftw> spectrum;  // real and imaginary parts in turn
  std::size_t capacity = 0;
};

Buffers& threadBuffers(std::size_t k) {
  thread_local Buffers buffers;
  buffers.reserve(k);
  return buffers;
}

fftwf_complex* asFftw(float* spectrum) {
  return reinterpret_cast<fftwf_complex*>(spectrum);
}

bool isFiveSmooth(std::size_t k) {
  for (const std::size_t prime : {2U, 3U, 5U})
    while (k % prime == 0) k /= prime;
  return k == 1;
}

/// product_j = conj(a_j) b_j for n complex numbers. Written out: std::complex's own product checks
/// for NaN, which keeps it from being vectorised.
POLYLOC_HOT_LOOP
void multiplyConjugate(const float* a, const float* b, float* product, std::size_t n) {
  for (std::size_t j = 0; j < 2 * n; j += 2) {
    product[j] = a[j] * b[j] + a[j + 1] * b[j + 1];
    product[j + 1] = a[j] * b[j + 1] - a[j + 1] * b[j];
  }
}

/// product_j += conj(a_j) b_j.
POLYLOC_HOT_LOOP
void addConjugateProduct(const float* a, const float* b, float* product, std::size_t n) {
  for (std::size_t j = 0; j < 2 * n; j += 2) {
    product[j] += a[j] * b[j] + a[j + 1] * b[j + 1];
    product[j + 1] += a[j] * b[j + 1] - a[j + 1] * b[j];
  }
}

// FFTW's planner is not thread-safe, its execution is.
std::mutex& plannerMutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

struct CirclePlan::Transforms {
  explicit Transforms(std::size_t k) {
    Buffers& buffers = threadBuffers(k);
    const int n = static_cast<int>(k);
    forward = fftwf_plan_dft_r2c_1d(n, buffers.samples.get(), asFftw(buffers.spectrum.get()),
                                    FFTW_ESTIMATE);
    backward = fftwf_plan_dft_c2r_1d(n, asFftw(buffers.spectrum.get()), buffers.samples.get(),
                                     FFTW_ESTIMATE);
    if (forward == nullptr || backward == nullptr) throw std::bad_alloc();
  }
  ~Transforms() {
    fftwf_destroy_plan(forward);
    fftwf_destroy_plan(backward);
  }
  Transforms(const Transforms&) = delete;
  Transforms& operator=(const Transforms&) = delete;

  fftwf_plan forward = nullptr;
  fftwf_plan backward = nullptr;
};

CirclePlan::CirclePlan(std::size_t k) : transforms_(std::make_unique<Transforms>(k)) {
  directions_.reserve(k);
  for (std::size_t i = 0; i < k; ++i) {
    const double phi = kTwoPi * static_cast<double>(i) / static_cast<double>(k);
    directions_.emplace_back(std::cos(phi), std::sin(phi));
  }
}

CirclePlan::~CirclePlan() = default;

const CirclePlan& CirclePlan::forSamples(std::size_t k) {
  constexpr std::size_t kMost = std::size_t{1} << 20;
  if (k < 2 || k > kMost || k % 2 != 0 || !isFiveSmooth(k))
    throw InvalidParamsError(
        "samples k = " + std::to_string(k) +
        " must be even, in [2, 1048576], and have no prime factor above 5 (360, 512, 720)");
  const std::lock_guard<std::mutex> lock(plannerMutex());
  static std::map<std::size_t, std::unique_ptr<CirclePlan>> plans;
  std::unique_ptr<CirclePlan>& plan = plans[k];
  if (!plan) plan.reset(new CirclePlan(k));
  return *plan;
}

std::vector<std::complex<float>> CirclePlan::spectrum(const float* samples) const {
  std::vector<std::complex<float>> result(spectrumSize());
  spectrum(samples, result.data());
  return result;
}

void CirclePlan::spectrum(const float* samples, std::complex<float>* spectrum) const {
  Buffers& buffers = threadBuffers(size());
  std::copy_n(samples, size(), buffers.samples.get());
  fftwf_execute_dft_r2c(transforms_->forward, buffers.samples.get(),
                        asFftw(buffers.spectrum.get()));
  const auto scale = static_cast<float>(1.0 / std::sqrt(static_cast<double>(size())));
  const float* const parts = buffers.spectrum.get();
  for (std::size_t j = 0; j < spectrumSize(); ++j)
    spectrum[j] = {scale * parts[2 * j], scale * parts[2 * j + 1]};
}

template <class Fill>
const float* CirclePlan::transformedBack(Fill fill) const {
  Buffers& buffers = threadBuffers(size());
  float* const product = buffers.spectrum.get();
  fill(product);
  fftwf_execute_dft_c2r(transforms_->backward, asFftw(product), buffers.samples.get());
  return buffers.samples.get();
}

const float* CirclePlan::correlation(const std::complex<float>* f,
                                     const std::complex<float>* g) const {
  return transformedBack([&](float* product) {
    multiplyConjugate(reinterpret_cast<const float*>(f), reinterpret_cast<const float*>(g), product,
                      spectrumSize());
  });
}

const float* CirclePlan::correlation(const std::complex<float>* f, const std::complex<float>* g,
                                     const std::complex<float>* f2,
                                     const std::complex<float>* g2) const {
  return transformedBack([&](float* product) {
    multiplyConjugate(reinterpret_cast<const float*>(f), reinterpret_cast<const float*>(g), product,
                      spectrumSize());
    addConjugateProduct(reinterpret_cast<const float*>(f2), reinterpret_cast<const float*>(g2),
                        product, spectrumSize());
  });
}

double CirclePlan::correlationError() const {
  return 4.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
         std::log2(2.0 * static_cast<double>(size()));
}

}  // namespace mrpt_polyloc
