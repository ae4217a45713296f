// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keeping/line_help.h"

#include <algorithm>
#include <cmath>

#include "geometry/fold/line_region.h"
#include "geometry/mesh/property_names.h"
#include "physics/cloth/struts.h"
#include "physics/plate/plate_bending.h"
#include "physics/plate/press.h"

namespace furrow::bridge {

std::vector<HelpedLine> helped_lines(const geometry::Mesh& mesh, const physics::Particles& particles,
                                     LineMeter& meter, const KeepOptions& o) {
  const auto id = geometry::find_map(mesh, geometry::attribute::line);
  const std::vector<double> drawn = meter.heights(particles), lengths = geometry::lengths_before_lines(mesh);
  const auto of_line = [](const std::vector<double>& list, int line, double missing) {
    return std::size_t(line) < list.size() ? list[std::size_t(line)] : missing;
  };
  std::vector<HelpedLine> lines;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    std::vector<geometry::Vertex> vertices;
    for (const geometry::Vertex v : mesh.vertices())
      if ((*id)[v] == meter.lines()[i]) vertices.push_back(v);
    HelpedLine line{meter.lines()[i], {}, drawn[i]};
    line.press = of_line(o.line_presses, line.id, 1);
    const double width = of_line(o.line_widths, line.id, NAN);
    line.width = width > 0 ? width : 0;
    for (const geometry::Vertex v : geometry::line_region(mesh, vertices, width, lengths))
      line.patch.push_back(int(v));
    lines.push_back(std::move(line));
  }
  return lines;
}

int help_steps(const KeepOptions& o) { return int(o.presses.size() + o.struts.size()); }

double press_of(const HelpedLine& line, const KeepOptions& o) {
  const int n = std::min(line.step, int(o.presses.size()));
  return n > 0 ? o.presses[n - 1] : 1;
}

double struts_of(const HelpedLine& line, const KeepOptions& o) {
  const int n = line.step - int(o.presses.size());
  return n > 0 ? o.struts[n - 1] : 0;
}

bool fails_anew(const Steps& steps, const std::vector<HelpedLine>& lines) {
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (steps[i] != 0 && lines[i].step == 0) return true;
  return false;
}

int add_help(const Steps& steps, int least, const KeepOptions& o, std::vector<HelpedLine>& lines) {
  int helped = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    int& step = lines[i].step;
    const int more = steps[i] != 0 && step > 0 ? 2 : int(steps[i]);
    const int now = std::min(std::max(step + more, least), help_steps(o));
    helped += now > step ? 1 : 0;
    step = now;
  }
  return helped;
}

namespace {

/// Of all plates, one plate after the other.
std::vector<physics::Hinge> coupled_hinges(const physics::Cloth& cloth) {
  std::vector<physics::Hinge> all;
  for (const auto& energy : cloth.energies)
    if (const auto* plate = dynamic_cast<const physics::PlateBending*>(energy.get()))
      all.insert(all.end(), plate->plate().hinges.begin(), plate->plate().hinges.end());
  return all;
}

}  // namespace

bool on_bounds(const HelpedLine& line, const physics::PrestressReport& rest, const physics::Cloth& cloth) {
  const auto on = [&](int v) { return std::binary_search(line.patch.begin(), line.patch.end(), v); };
  const auto any_spring = [&](const std::vector<int>& list, const auto& springs) {
    return std::any_of(list.begin(), list.end(), [&](int i) { return on(springs[i].a) && on(springs[i].b); });
  };
  const auto any = [&](const std::vector<int>& list, const auto& elements) {
    return std::any_of(list.begin(), list.end(), [&](int i) {
      return std::all_of(elements[i].vertices.begin(), elements[i].vertices.end(), on);
    });
  };
  return any_spring(rest.structural, cloth.structural) || any_spring(rest.bending, cloth.bending) ||
         any_spring(rest.tension, cloth.tension) || any(rest.membrane, cloth.membrane) ||
         any(rest.hinges, cloth.hinges) || any(rest.coupled, coupled_hinges(cloth));
}

void place_lines(const std::vector<HelpedLine>& lines, const geometry::Mesh& mesh,
                 const physics::Particles& drawn, physics::Particles& particles) {
  const auto rest = geometry::find_map(mesh, geometry::attribute::rest_position);
  for (const HelpedLine& line : lines) {
    if (line.height == 1 || !rest) continue;
    for (const int i : line.patch) {
      const auto& at = (*rest)[geometry::Vertex(i)];
      const physics::Vec3 flat(at[0], at[1], at[2]);
      if (particles.inv_mass[i] > 0 && flat.allFinite())
        particles.x[i] = flat + line.height * (drawn.x[i] - flat);
    }
  }
}

namespace {

std::vector<char> in_any(const std::vector<HelpedLine>& lines, std::size_t vertices) {
  std::vector<char> inside(vertices, 0);
  for (const HelpedLine& line : lines)
    for (const int i : line.patch) inside[i] = 1;
  return inside;
}

}  // namespace

void stiffen_lines(const std::vector<HelpedLine>& lines, const KeepOptions& o, double rest_press,
                   physics::Cloth& cloth) {
  const std::vector<char> inside = in_any(lines, cloth.particles.size());
  if (rest_press != 1)
    physics::press_hinges(
        cloth, [&](const physics::Hinge& h) { return !inside[h.vertices[0]] || !inside[h.vertices[1]]; },
        rest_press);
  double last = 1;
  for (std::size_t k = 0; k < o.presses.size(); ++k) {
    std::vector<int>
        patch;  // of all lines that are at this step or beyond, so that no hinge is pressed twice
    for (const HelpedLine& line : lines)
      if (line.step > int(k)) patch.insert(patch.end(), line.patch.begin(), line.patch.end());
    physics::press(cloth, patch, o.presses[k] / last);
    last = o.presses[k];
  }
  for (const HelpedLine& line : lines)
    if (struts_of(line, o) > 0)
      physics::add_struts(cloth, line.patch, {.stiffness = struts_of(line, o), .width = line.width});
}

std::vector<double> shares_of(const std::vector<HelpedLine>& lines, const physics::Particles& particles,
                              const std::vector<physics::Vec3>& motion) {
  std::vector<double> shares(lines.size() + 1, 0.0);
  const auto energy = [&](std::size_t i) { return particles.mass[i] * motion[i].squaredNorm(); };
  double whole = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) whole += energy(i);
  if (!(whole > 0)) return shares;
  for (std::size_t k = 0; k < lines.size(); ++k)
    for (const int i : lines[k].patch) shares[k] += energy(i) / whole;
  const std::vector<char> inside = in_any(lines, particles.size());
  for (std::size_t i = 0; i < motion.size(); ++i)
    if (!inside[i]) shares.back() += energy(i) / whole;
  return shares;
}

}  // namespace furrow::bridge
