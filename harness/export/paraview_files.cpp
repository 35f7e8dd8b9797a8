// SPDX-License-Identifier: MIT
#include "paraview_files.hpp"

#include <fmt/format.h>

#include <iterator>

namespace shakedown {

namespace {

constexpr const char* start =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\">\n";

std::string array(const char* name, const std::vector<Vec3>& values) {
  std::string text = fmt::format(
      "<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"3\" format=\"ascii\">\n", name);
  for (const Vec3& v : values) fmt::format_to(std::back_inserter(text), "{} {} {}\n", v.x(), v.y(), v.z());
  return text + "</DataArray>\n";
}

template <class Number>
std::string array(const char* name, const std::vector<Number>& values) {
  std::string text = fmt::format("<DataArray type=\"{}\" Name=\"{}\" format=\"ascii\">\n",
                                 std::is_same_v<Number, double> ? "Float64" : "Int32", name);
  for (const Number value : values) fmt::format_to(std::back_inserter(text), "{} ", value);
  return text + "\n</DataArray>\n";
}

std::vector<int> numbers(std::size_t count, int first, int step) {
  std::vector<int> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(first + step * static_cast<int>(i));
  return all;
}

std::string time_value(double time) {
  return fmt::format(
      "<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
      "format=\"ascii\">{}</DataArray></FieldData>\n",
      time);
}

}  // namespace

std::string grains_vtp(const Frame& frame) {
  const State& s = frame.state;
  const std::size_t n = s.size();
  return fmt::format(start, "PolyData") + "<PolyData>\n" + time_value(frame.time) +
         fmt::format(
             "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
             "NumberOfPolys=\"0\">\n<PointData "
             "Scalars=\"radius\" Vectors=\"velocity\">\n",
             n, n) +
         array("id", numbers(n, 1, 1)) + array("radius", s.radius) + array("mass", s.mass) +
         array("velocity", s.velocity) + (s.spin.empty() ? "" : array("spin", s.spin)) +
         "</PointData>\n<Points>\n" + array("position", s.position) + "</Points>\n<Verts>\n" +
         array("connectivity", numbers(n, 0, 1)) + array("offsets", numbers(n, 1, 1)) +
         "</Verts>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string box_vtp(const Frame& frame) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k)
    corners.emplace_back((k & 1 ? frame.box_high : frame.box_low).x(),
                         (k & 2 ? frame.box_high : frame.box_low).y(),
                         (k & 4 ? frame.box_high : frame.box_low).z());
  const std::vector<int> faces{0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3};
  return fmt::format(start, "PolyData") + "<PolyData>\n" + time_value(frame.time) +
         "<Piece NumberOfPoints=\"8\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
         "NumberOfPolys=\"6\">\n<Points>\n" +
         array("position", corners) + "</Points>\n<Polys>\n" + array("connectivity", faces) +
         array("offsets", numbers(6, 4, 4)) + "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string pvd(const std::vector<PvdEntry>& entries) {
  std::string text = fmt::format(start, "Collection") + "<Collection>\n";
  for (const PvdEntry& entry : entries)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", entry.time, entry.part,
                        entry.file);
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace shakedown
