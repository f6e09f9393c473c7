#include "report/files/vtk_files.h"

#include <fmt/format.h>

#include <iterator>
#include <pugixml.hpp>
#include <sstream>

namespace slipcheck {
namespace {

using pugi::xml_node;

struct Document {
  pugi::xml_document document;
  xml_node root;

  explicit Document(const char* type) : root(document.append_child("VTKFile")) {
    root.append_attribute("type") = type;
    root.append_attribute("version") = "1.0";
    root.append_attribute("byte_order") = "LittleEndian";
    root.append_attribute("header_type") = "UInt64";
  }

  std::string text() const {
    std::ostringstream stream;
    document.save(stream, " ");
    return stream.str();
  }
};

/// `values(i)` gives body i's, a number or a vector.
template <class Values>
xml_node add_array(xml_node parent, const char* type, const char* name, std::size_t count,
                   const Values& values) {
  xml_node array = parent.append_child("DataArray");
  array.append_attribute("type") = type;
  array.append_attribute("Name") = name;
  array.append_attribute("format") = "ascii";
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    if constexpr (std::is_convertible_v<decltype(values(i)), Vector3>) {
      const Vector3 vector = values(i);
      fmt::format_to(std::back_inserter(text), "{} {} {} ", vector.x(), vector.y(), vector.z());
    } else {
      fmt::format_to(std::back_inserter(text), "{} ", values(i));
    }
  }
  array.text() = text.c_str();
  return array;
}

template <class Values>
void add_vectors(xml_node parent, const char* name, std::size_t count, const Values& values) {
  add_array(parent, "Float64", name, count, values).append_attribute("NumberOfComponents") = 3;
}

}  // namespace

std::string vtk_frame_of(const Scenario& scenario, double time,
                         const std::vector<BodyState>& bodies) {
  Document file("PolyData");
  xml_node data = file.root.append_child("PolyData");
  add_array(data.append_child("FieldData"), "Float64", "TimeValue", 1, [&](std::size_t) {
    return time;
  }).append_attribute("NumberOfTuples") = 1;

  const std::size_t count = bodies.size();
  xml_node piece = data.append_child("Piece");
  piece.append_attribute("NumberOfPoints") = count;
  piece.append_attribute("NumberOfVerts") = count;

  xml_node at_points = piece.append_child("PointData");
  at_points.append_attribute("Scalars") = "radius";
  at_points.append_attribute("Vectors") = "velocity";
  add_vectors(at_points, "velocity", count, [&](std::size_t i) { return bodies[i].velocity; });
  add_vectors(at_points, "angular_velocity", count,
              [&](std::size_t i) { return bodies[i].angular_velocity; });
  add_array(at_points, "Float64", "radius", count,
            [&](std::size_t i) { return scenario.bodies[i].sphere.radius; });
  add_array(at_points, "Int32", "body", count, [](std::size_t i) { return i; });

  add_vectors(piece.append_child("Points"), "position", count,
              [&](std::size_t i) { return bodies[i].position; });
  // Points without cells are not drawn.
  xml_node vertices = piece.append_child("Verts");
  add_array(vertices, "Int64", "connectivity", count, [](std::size_t i) { return i; });
  add_array(vertices, "Int64", "offsets", count, [](std::size_t i) { return i + 1; });
  return file.text();
}

std::string vtk_frame_name(const std::string& stem, std::size_t frame) {
  return fmt::format("{}_{:04}.vtp", stem, frame);
}

std::string vtk_collection_of(const std::vector<double>& times, const std::string& stem) {
  Document file("Collection");
  xml_node collection = file.root.append_child("Collection");
  for (std::size_t k = 0; k < times.size(); ++k) {
    xml_node entry = collection.append_child("DataSet");
    entry.append_attribute("timestep") = fmt::format("{}", times[k]).c_str();
    entry.append_attribute("part") = 0;
    entry.append_attribute("file") = vtk_frame_name(stem, k).c_str();
  }
  return file.text();
}

std::vector<std::pair<std::string, std::string>> vtk_files_of(const Scenario& scenario,
                                                              const RecordedMotion& motion,
                                                              const std::string& stem) {
  std::vector<std::pair<std::string, std::string>> files(1);
  std::vector<double> times;
  for (const MotionFrame& frame : motion.frames) {
    files.emplace_back(vtk_frame_name(stem, times.size()),
                       vtk_frame_of(scenario, frame.time, frame.bodies));
    times.push_back(frame.time);
  }
  files[0] = {stem + ".pvd", vtk_collection_of(times, stem)};
  return files;
}

}  // namespace slipcheck
