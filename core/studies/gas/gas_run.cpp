#include "studies/gas/gas_run.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/stop_scope.h"
#include "physics/granular_gas.h"
#include "reference/gas/sonine.h"

namespace slipcheck {
namespace {

struct MeanOfMany {
  double count = 0, sum = 0, squares = 0;
  void add(double x) { count += 1, sum += x, squares += x * x; }
  Measured mean() const {
    const double mean = sum / count;
    const double variance = std::max(0.0, squares / count - mean * mean) / (count - 1);
    return {mean, count > 1 ? std::sqrt(variance) : std::nan("")};
  }
};

/// What the batches of one sample say: ⟨v²⟩, ⟨v⁴⟩, ⟨w²⟩ of all, and of each over that of all.
struct Moments {
  explicit Moments(const std::vector<GasMoments>& batches) {
    GasMoments sum;
    for (const GasMoments& each : batches) {
      sum.particles += each.particles;
      sum.v2 += each.v2;
      sum.v4 += each.v4;
      sum.w2 += each.w2;
    }
    v2 = sum.v2 / sum.particles;
    v4 = sum.v4 / sum.particles;
    w2 = sum.w2 / sum.particles;
    const auto over = [](double x, double of) { return of > 0 ? x / of : 0; };
    for (const GasMoments& each : batches)
      if (each.particles > 0)
        parts.push_back({each.particles, over(each.v2 / each.particles, v2),
                         over(each.v4 / each.particles, v4), over(each.w2 / each.particles, w2)});
  }
  /// The standard error of what depends on a batch so, in proportion to what is there.
  template <class Share>
  double error(Share share) const {
    MeanOfMany mean;
    for (const GasMoments& part : parts) mean.add(share(part));
    return mean.mean().error;
  }
  double v2, v4, w2;
  std::vector<GasMoments> parts;
};

double a2_share(const GasMoments& part) { return part.v4 - 2 * part.v2; }
double ratio_share(const GasMoments& part) { return part.w2 - part.v2; }

/// Straight line through points with errors alike.
struct Line {
  double slope, error;
};
Line line_through(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0, my = 0, xx = 0, xy = 0, rest = 0;
  for (std::size_t k = 0; k < x.size(); ++k) mx += x[k] / n, my += y[k] / n;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mx) * (x[k] - mx);
    xy += (x[k] - mx) * (y[k] - my);
  }
  const double slope = xy / xx;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double off = y[k] - my - slope * (x[k] - mx);
    rest += off * off;
  }
  return {slope, std::sqrt(rest / ((n - 2) * xx))};
}

class Observation {
 public:
  Observation(const GasOptions& options, const GasLaw& law) : options_(options), law_(law) {}

  void look(const Gas& gas) {
    const Moments moments(gas.moments());
    const GasSetup& setup = options_.setup;
    const double D = setup.dimensions, D_rot = 0.5 * D * (D - 1), m = setup.sphere.mass;
    GasSample sample;
    sample.time = gas.now();
    sample.collisions = gas.collisions_per_particle();
    const double T = m * moments.v2 / D;
    const double T_rot = setup.sphere.shape_factor * m * moments.w2 / D_rot;
    sample.translation = {T, T * moments.error([](const GasMoments& part) { return part.v2; })};
    const double fourth = D / (D + 2) * moments.v4 / (moments.v2 * moments.v2);
    sample.a2 = {fourth - 1, fourth * moments.error(a2_share)};
    if (gas.spins()) {
      sample.rotation = {T_rot,
                         T_rot * moments.error([](const GasMoments& part) { return part.w2; })};
      sample.ratio = {T_rot / T, T_rot / T * moments.error(ratio_share)};
    }
    run_.samples.push_back(sample);
  }

  GasRun finish(const Gas& gas) {
    run_.collisions = gas.collisions();
    run_.cells = gas.cells();
    run_.overtaken = gas.overtaken();
    std::vector<double> times;
    for (const GasSample& sample : run_.samples) times.push_back(sample.time);
    const std::vector<GasTemperatures> course = mean_field_course(law_, options_.setup, times);
    for (std::size_t k = 0; k < course.size(); ++k) run_.samples[k].mean_field = course[k];
    first_ = run_.samples.size() / 2;
    if (run_.samples.size() < first_ + 4) return run_;
    state_cumulant();
    state_cooling();
    state_partition(gas.spins());
    return run_;
  }

 private:
  bool is_haff() const { return law_.constant() && !law_.rough(); }
  double e() const { return std::get<double>(law_.hard.restitution); }

  /// The mean over the second half of the samples. They remember each other, all together for
  /// longer than a single particle: the sum of their correlations up to the first that is none
  /// makes the error √(1 + 2 Σ ρ_j (1 − j/n)) times as large.
  template <class Value>
  Measured mean_over_samples(Value value) const {
    std::vector<double> x;
    double mean = 0, variance = 0;
    for (std::size_t k = first_; k < run_.samples.size(); ++k) {
      const Measured each = value(run_.samples[k]);
      x.push_back(each.value);
      mean += each.value;
      variance += each.error * each.error;
    }
    const auto n = static_cast<double>(x.size());
    mean /= n;
    const auto correlation = [&](std::size_t j) {
      double sum = 0;
      for (std::size_t k = j; k < x.size(); ++k) sum += (x[k] - mean) * (x[k - j] - mean);
      return sum;
    };
    double memory = 1;
    for (std::size_t j = 1; j < x.size() && correlation(j) > 0; ++j)
      memory += 2 * (1 - static_cast<double>(j) / n) * correlation(j) / correlation(0);
    return {mean, std::sqrt(variance * memory) / n};
  }

  void state_cumulant() {
    const Measured a2 = mean_over_samples([](const GasSample& sample) { return sample.a2; });
    a2_ = a2.value;
    if (!is_haff()) {
      run_.statements.push_back({"a_2", a2});
      return;
    }
    const int D = options_.setup.dimensions;
    run_.statements.push_back(
        {"a_2", a2, sonine_cooling_state(D, e()).a2, "with a_3, Brilliantov and Poeschel 2006"});
    run_.statements.push_back({"a_2", a2, montanero_santos(D, e()), "Montanero and Santos 2000"});
    run_.statements.push_back({"a_2", a2, van_noije_ernst(D, e()), "van Noije and Ernst 1998"});
  }

  void state_cooling() {
    std::vector<double> log_T, log_rate;
    MeanOfMany cooled, expected, ahead;
    const GasSetup& setup = options_.setup;
    for (std::size_t k = first_; k + 1 < run_.samples.size(); ++k) {
      const GasSample &a = run_.samples[k], &b = run_.samples[k + 1];
      const double fall = std::log(a.translation.value / b.translation.value);
      const double per_collision = fall / (b.collisions - a.collisions);
      const double T = std::sqrt(a.translation.value * b.translation.value);
      double theory = haff_cooling(setup.dimensions, law_.constant() ? e() : 1, a2_);
      if (!is_haff()) {
        // NaN of smooth spheres is no T_rot.
        const double T_rot = law_.rough() ? 0.5 * (a.rotation.value + b.rotation.value) : 0;
        theory =
            -mean_field_cooling(law_, setup.sphere, setup.dimensions, {T, T_rot}).translation / T;
      }
      cooled.add(per_collision);
      expected.add(theory);
      ahead.add(per_collision - theory);
      if (fall > 0) {
        log_T.push_back(std::log(T));
        log_rate.push_back(std::log(fall / (b.time - a.time)));
      }
    }
    run_.statements.push_back({"cooling per collision",
                               {cooled.mean().value, ahead.mean().error},
                               expected.mean().value,
                               is_haff() ? "Haff 1983 with this a_2" : "mean field"});
    // −d ln T/dt ~ T^(1/p) belongs to T ~ (t + t_0)^(−p), whatever t_0. A gas that has not cooled
    // says nothing.
    if (log_T.size() < 4 || log_T.front() - log_T.back() < 0.5) return;
    const Line line = line_through(log_T, log_rate);
    GasStatement statement{"exponent of T(t)",
                           {-1 / line.slope, line.error / (line.slope * line.slope)}};
    if (options_.speed_exponent) {
      statement.theory = -2 / (1 + *options_.speed_exponent);
      statement.source =
          *options_.speed_exponent == 0 ? "Haff 1983" : "Schwager and Poeschel 1998, e -> 1";
    }
    run_.statements.push_back(statement);
  }

  void state_partition(bool spins) {
    if (!spins) return;
    const Measured ratio = mean_over_samples([](const GasSample& sample) { return sample.ratio; });
    MeanOfMany theory;
    for (std::size_t k = first_; k < run_.samples.size(); ++k) {
      const GasTemperatures& both = run_.samples[k].mean_field;
      theory.add(both.rotation / both.translation);
    }
    run_.statements.push_back(
        {"T_rot/T", ratio, theory.mean().value, "mean field, Huthmann and Zippelius 1997"});
  }

  const GasOptions& options_;
  const GasLaw& law_;
  GasRun run_;
  std::size_t first_ = 0;  // sample of the statements
  double a2_ = 0;
};

}  // namespace

GasRun run_gas(const GasOptions& options, const GasLaw& law) {
  Gas gas(options.setup, law);
  Observation observation(options, law);
  observation.look(gas);
  bool interrupted = false;
  try {
    for (std::size_t k = 1; k <= options.samples; ++k) {
      const double next =
          options.collisions * static_cast<double>(k) / static_cast<double>(options.samples);
      if (gas.collisions_per_particle() >= next) continue;  // steps longer than between samples
      while (gas.collisions_per_particle() < next) {
        gas.advance();
        options.progress(gas.collisions_per_particle());
      }
      observation.look(gas);
    }
  } catch (const Interrupted&) {
    interrupted = true;
  }
  GasRun run = observation.finish(gas);
  run.interrupted = interrupted;
  return run;
}

}  // namespace slipcheck
