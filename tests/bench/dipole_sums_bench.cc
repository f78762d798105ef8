// Time of the dipole's inner loops beside what the processor could do at best: nanoseconds a row
// and point (or cluster), and of as many fused multiply-adds as the loop has vector operations.
#include <algorithm>
#include <chrono>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/sums/dipole_kernels.h"
#include "core/sums/dipole_sums.h"

namespace scattermeter {
namespace {

constexpr Medium kMedium{2.19, 0.002, 1.3};

KernelDipole bench_dipole() {
  const Dipole d(kMedium);
  return {d.z_r_mm(), d.z_v_mm(), d.sigma_tr_per_mm()};
}

#if defined(__x86_64__)
using V8 = float __attribute__((vector_size(32)));
using V16 = float __attribute__((vector_size(64)));

// Twelve independent chains of multiply-adds.
#define SCATTERMETER_PEAK(name, set, Vector)                              \
  __attribute__((target(set), noinline)) float name(int turns) {          \
    Vector a[12];                                                         \
    for (int i = 0; i < 12; ++i) a[i] = Vector{} + static_cast<float>(i); \
    const Vector m = Vector{} + 0.999F, b = Vector{} + 1e-3F;             \
    for (int i = 0; i < turns; ++i) {                                     \
      for (Vector & x : a) x = x * m + b;                                 \
    }                                                                     \
    Vector sum = a[0];                                                    \
    for (int i = 1; i < 12; ++i) sum += a[i];                             \
    return sum[0];                                                        \
  }
SCATTERMETER_PEAK(peak_avx2, "avx2,fma", V8)
SCATTERMETER_PEAK(peak_avx3, "avx512f", V16)
#undef SCATTERMETER_PEAK
#endif

// Nanoseconds of a fused multiply-add, by lane, at its best; 0 where it is not known how.
double fma_ns(const std::string& set) {
#if defined(__x86_64__)
  float (*const run)(int) = set == "AVX2" ? peak_avx2 : set == "AVX3" ? peak_avx3 : nullptr;
  if (run == nullptr) return 0.0;
  constexpr int kTurns = 200000;
  double best = 1e9;
  for (int i = 0; i < 10; ++i) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(run(kTurns));
    best = std::min(
        best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 1e9 * best / (12.0 * kTurns * (set == "AVX2" ? 8.0 : 16.0));
#else
  return 0.0;
#endif
}

// One row after the other along a line.
RowLanes bench_rows() {
  RowLanes rows;
  for (std::size_t i = 0; i < kRowLanes; ++i) {
    rows.x[i] = 4.0 + 0.05 * static_cast<double>(i);
    rows.y[i] = rows.z[i] = 0.5;
  }
  return rows;
}

// Vector operations of a pair, counted in core/sums/dipole_kernels.cc: 3 + 4 for the distance, 27 a
// pole, 9 to add up.
constexpr double kPairOperations = 3 + 4 + 2 * 27 + 9;

void report(benchmark::State& state, const std::string& set, double pairs, double operations) {
  state.counters["ns_each"] = benchmark::Counter(
      1e-9 * pairs, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["ns_floor"] = operations * fma_ns(set);
}

void bm_points(benchmark::State& state, const char* set) {
  if (!choose_kernel_instruction_set(set)) return state.SkipWithError("not on this processor");
  const auto n = static_cast<std::size_t>(state.range(0));
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  std::vector<float> x(n), y(n), z(n), w(n, 1.0F);
  for (auto* v : {&x, &y, &z}) {
    for (float& f : *v) f = uniform(random);
  }
  const RowLanes rows = bench_rows();
  const KernelDipole dipole = bench_dipole();
  const KernelPoints points{{0, 0, 0}, x.data(), y.data(), z.data(), w.data(), n};
  LaneSums sums{};
  for (auto _ : state) {
    add_point_sums({&dipole, 1}, rows, {&points, 1}, 1.0, {&sums, 1});
    benchmark::DoNotOptimize(sums);
  }
  report(state, set, static_cast<double>(kRowLanes * n), kPairOperations);
  choose_kernel_instruction_set("");
}

void bm_series(benchmark::State& state, const char* set) {
  if (!choose_kernel_instruction_set(set)) return state.SkipWithError("not on this processor");
  const auto degree = static_cast<int>(state.range(0));
  const bool planar = state.range(1) != 0;
  const std::size_t count = coefficient_index(degree + 1, 0, planar);
  const std::vector<float> coefficients(count, 1e-3F);
  const float frame[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const RowLanes rows = bench_rows();
  const KernelDipole dipole = bench_dipole();
  const KernelSeries series{{{0, 0, 0}, 1.0, frame, coefficients.data(), planar}, degree, 1.0};
  LaneSums sums{};
  for (auto _ : state) {
    add_cluster_sums({&dipole, 1}, rows, {&series, 1}, {&sums, 1});
    benchmark::DoNotOptimize(sums);
  }
  // An operation a coefficient, one a monomial, and by pole: 18 and 5 a term.
  double operations = static_cast<double>(count);
  for (int k = 1; degree > 1 && k <= degree; ++k) {
    operations += static_cast<double>(monomials_of_degree(k, planar));
  }
  operations += 2.0 * (18.0 + 5.0 * (degree == 1 ? 1 : degree + 1));
  report(state, set, static_cast<double>(kRowLanes), operations);
  choose_kernel_instruction_set("");
}

// All of it, on a lit square: 10^4 rows.
void bm_sums(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-10.0, 10.0);
  std::vector<Eigen::Vector3d> points, at;
  for (std::size_t i = 0; i < n; ++i) points.emplace_back(uniform(random), uniform(random), 0.0);
  const std::size_t n_rows = std::min<std::size_t>(n, 10000);
  at.assign(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(n_rows));
  const SourceClusters sources(points, std::vector<double>(n, 1.0));
  const RowBlocks rows(at);
  std::vector<std::vector<DipoleSum>> out(1, std::vector<DipoleSum>(n_rows));
  for (auto _ : state) sum_dipoles(sources, rows, {&kMedium, 1}, out);
  state.counters["ns_each"] = benchmark::Counter(
      1e-9 * static_cast<double>(n_rows * n),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(bm_points, AVX2, "AVX2")->Arg(8)->Arg(256);
BENCHMARK_CAPTURE(bm_points, AVX3, "AVX3")->Arg(8)->Arg(256);
BENCHMARK_CAPTURE(bm_series, AVX2, "AVX2")->ArgsProduct({{1, 2, 4, 6, 8}, {0, 1}});
BENCHMARK_CAPTURE(bm_series, AVX3, "AVX3")->ArgsProduct({{1, 2, 4, 6, 8}, {0, 1}});
BENCHMARK(bm_sums)->Arg(1000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(bm_points, smoke, "")->Arg(8);

}  // namespace
}  // namespace scattermeter
