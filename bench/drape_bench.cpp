// SPDX-License-Identifier: GPL-3.0-or-later
// What a fit costs a vertex, as a table (CSV): garments of cotton draped as `furrow drape` does, nothing
// held.
//   drape_bench [OPTIONS] GARMENT BODY [GARMENT BODY …]
//     --refinements 0,1,2  how often each garment is refined (Loop); 1,2,3: a catalogue's T-shirt of 3,150,
//                          12,414 and 49,278 vertices
//     --best 3             runs; the fastest by the clock is shown
//     --threads N          of the factorisation; default: the machine's
//     --iterations 200     at most, on each level
//     --residual 1e-3      at which it rests
//     --plain N            the plain scheme instead, at most N passes a level
// The body's field is built before and does not count. A row for each level of a fit, with the refinement
// before it, and one, `all`, for the whole.
#include <chrono>
#include <cstdio>
#include <ctime>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "io/scene/fabrics.h"
#include "tests/cases/garment_pair.h"

namespace furrow::bench {
namespace {

struct Arguments {
  std::vector<int> refinements{0, 1, 2};
  int best = 3;
  int threads = int(std::max(1u, std::thread::hardware_concurrency()));
  int iterations = physics::SettleOptions{}.max_iterations;
  int plain = 0;  ///< passes; 0: not plain
  double residual = physics::SettleOptions{}.tolerance;
  std::vector<std::string> files;
};

struct Time {
  double clock = 0, processor = 0;  ///< [s]; of all threads
  Time operator-(const Time& other) const { return {clock - other.clock, processor - other.processor}; }
};
Time now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return {std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(),
          double(t.tv_sec) + 1e-9 * double(t.tv_nsec)};
}

struct Run {
  bridge::DrapeReport report;
  std::vector<Time> times;  ///< when each level began, and when the last one ended
  Time whole() const { return times.back() - times.front(); }
};

Run run(const cases::GarmentPair& pair, int refinements, const Arguments& a) {
  bridge::DrapeOptions options;
  options.refinements = refinements;
  options.plain = a.plain > 0;
  options.settle.friction = io::fabric_named("cotton").friction;
  options.settle.gap = cases::gap_of(pair, refinements);
  options.settle.tolerance = a.residual;
  options.settle.max_iterations = a.plain > 0 ? a.plain : a.iterations;
  options.settle.threads = a.threads;
  Run result;
  const bridge::MakeCloth make = cases::make_cotton(pair);
  const auto timed = [&](geometry::Mesh& mesh) {
    result.times.push_back(now());
    return make(mesh);
  };
  geometry::Mesh garment = pair.garment;
  physics::Cloth cloth;
  result.report = bridge::drape(garment, cloth, &pair.field, options, timed);
  result.times.push_back(now());
  return result;
}

void print_row(const std::string& begin, const std::string& level, std::size_t vertices, const Time& time,
               const physics::SettleReport& s) {
  const double factorisation = s.factorisations ? 1e3 * time.clock / s.factorisations : 0;
  std::printf("%s,%s,%zu,%.4f,%.4f,%d,%d,%.2g,%s,%d,%.2f,%.2f\n", begin.c_str(), level.c_str(), vertices,
              time.clock, time.processor, s.iterations, s.factorisations, s.residual,
              s.converged ? "yes" : "no", s.touching, 1e6 * time.clock / double(vertices), factorisation);
}

void print(const std::string& garment, int refinements, const Arguments& a, const Run& r) {
  const std::string begin =
      garment + "," + (a.plain > 0 ? "plain" : "settle") + "," + std::to_string(refinements);
  physics::SettleReport sum = r.report.levels.back().settle;
  sum.iterations = sum.factorisations = 0;
  for (std::size_t i = 0; i < r.report.levels.size(); ++i) {
    const bridge::DrapeLevel& level = r.report.levels[i];
    print_row(begin, std::to_string(i), level.vertices, r.times[i + 1] - r.times[i], level.settle);
    sum.iterations += level.settle.iterations;
    sum.factorisations += level.settle.factorisations;
  }
  print_row(begin, "all", r.report.levels.back().vertices, r.whole(), sum);
  std::fflush(stdout);
}

void measure(const std::string& garment, const std::string& body, const Arguments& a) {
  const cases::GarmentPair pair = cases::read_pair(garment, body, a.threads);
  const std::string name = std::filesystem::path(garment).stem().string();
  for (const int refinements : a.refinements) {
    Run best = run(pair, refinements, a);
    for (int i = 1; i < a.best; ++i) {
      Run next = run(pair, refinements, a);
      if (next.whole().clock < best.whole().clock) best = std::move(next);
    }
    print(name, refinements, a, best);
  }
}

double number(const std::string& option, const std::string& text) {
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::logic_error&) {
  }
  if (used == 0 || used < text.size() || !(value >= 0))
    throw std::invalid_argument(option + " takes a number >= 0, not '" + text + "'");
  return value;
}

Arguments arguments_of(int count, char** words) {
  Arguments a;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word.rfind("--", 0) != 0) {
      a.files.push_back(word);
      continue;
    }
    if (++i == count) throw std::invalid_argument(word + " takes a value");
    if (word == "--refinements") {
      a.refinements.clear();
      std::istringstream list(words[i]);
      for (std::string item; std::getline(list, item, ',');) a.refinements.push_back(int(number(word, item)));
      continue;
    }
    const double value = number(word, words[i]);
    if (word == "--best")
      a.best = int(value);
    else if (word == "--threads")
      a.threads = int(value);
    else if (word == "--iterations")
      a.iterations = int(value);
    else if (word == "--plain")
      a.plain = int(value);
    else if (word == "--residual")
      a.residual = value;
    else
      throw std::invalid_argument("there is no option " + word);
  }
  if (a.best < 1) throw std::invalid_argument("--best takes a number >= 1");
  if (a.files.empty() || a.files.size() % 2) throw std::invalid_argument("name garments, each with its body");
  return a;
}

}  // namespace
}  // namespace furrow::bench

int main(int count, char** words) {
  using namespace furrow::bench;
  try {
    const Arguments a = arguments_of(count, words);
    std::printf("# best of %d by the clock, %d threads\n", a.best, a.threads);
    std::printf(
        "garment,scheme,refinements,level,vertices,clock [s],processor [s],iterations,factorisations,"
        "residual [-],at rest,touching,clock a vertex [us],clock a factorisation [ms]\n");
    for (std::size_t i = 0; i < a.files.size(); i += 2) measure(a.files[i], a.files[i + 1], a);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "drape_bench: %s\n", e.what());
    return 2;
  }
}
