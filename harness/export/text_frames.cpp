// SPDX-License-Identifier: MIT
#include "text_frames.hpp"

#include <fmt/format.h>

#include <iterator>

namespace shakedown {

namespace {

void append_text(std::string& text, const Vec3& v, char separator) {
  fmt::format_to(std::back_inserter(text), "{}{}{}{}{}{}", v.x(), separator, v.y(), separator, v.z(),
                 separator);
}

}  // namespace

std::string extended_xyz(const Frame& frame) {
  const State& s = frame.state;
  const Vec3 size = frame.box_high - frame.box_low;
  std::string text = fmt::format(
      "{}\nLattice=\"{} 0 0 0 {} 0 0 0 {}\" Origin=\"{} {} {}\" "
      "Properties=species:S:1:pos:R:3:velo:R:3:momenta:R:3:radius:R:1:mass:R:1:masses:R:1{}:id:I:1 Time={} "
      "box_position={} box_velocity={} units=SI pbc=\"F F F\"\n",
      s.size(), size.x(), size.y(), size.z(), frame.box_low.x(), frame.box_low.y(), frame.box_low.z(),
      s.spin.empty() ? "" : ":angular_velocity:R:3", frame.time, s.x_box, s.v_box);
  for (std::size_t i = 0; i < s.size(); ++i) {
    text += "X ";
    append_text(text, s.position[i], ' ');
    append_text(text, s.velocity[i], ' ');
    append_text(text, s.mass[i] * s.velocity[i], ' ');
    fmt::format_to(std::back_inserter(text), "{} {} {} ", s.radius[i], s.mass[i], s.mass[i]);
    if (!s.spin.empty()) append_text(text, s.spin[i], ' ');
    fmt::format_to(std::back_inserter(text), "{}\n", i + 1);
  }
  return text;
}

std::string lammps_dump(const Frame& frame) {
  const State& s = frame.state;
  std::string text = fmt::format(
      "ITEM: UNITS\nsi\nITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff "
      "ff ff\n",
      frame.time, frame.number, s.size());
  for (int axis = 0; axis < 3; ++axis)
    text += fmt::format("{} {}\n", frame.box_low[axis], frame.box_high[axis]);
  text += "ITEM: ATOMS id type x y z vx vy vz radius mass";
  text += s.spin.empty() ? "\n" : " omegax omegay omegaz\n";
  for (std::size_t i = 0; i < s.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{} 1 ", i + 1);
    append_text(text, s.position[i], ' ');
    append_text(text, s.velocity[i], ' ');
    fmt::format_to(std::back_inserter(text), "{} {} ", s.radius[i], s.mass[i]);
    if (!s.spin.empty()) append_text(text, s.spin[i], ' ');
    text.back() = '\n';
  }
  return text;
}

std::string csv_header(bool spins) {
  return std::string("t_s,grain,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s,") +
         (spins ? "spin_x_rad_per_s,spin_y_rad_per_s,spin_z_rad_per_s," : "") +
         "radius_m,mass_kg,x_box_m,v_box_m_per_s\n";
}

std::string csv_lines(const Frame& frame) {
  const State& s = frame.state;
  std::string text;
  for (std::size_t i = 0; i < s.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{},", frame.time, i + 1);
    append_text(text, s.position[i], ',');
    append_text(text, s.velocity[i], ',');
    if (!s.spin.empty()) append_text(text, s.spin[i], ',');
    fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", s.radius[i], s.mass[i], s.x_box, s.v_box);
  }
  return text;
}

}  // namespace shakedown
