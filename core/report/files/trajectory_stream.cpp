#include "report/files/trajectory_stream.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>
#include <utility>

#include "report/files/extended_xyz.h"
#include "report/files/files.h"
#include "report/files/vtk_files.h"

namespace slipcheck {

namespace fs = std::filesystem;

TrajectoryStream::TrajectoryStream(const Scenario& scenario, fs::path folder, std::string stem,
                                   Form form)
    : scenario_(&scenario), folder_(std::move(folder)), stem_(std::move(stem)), form_(form) {}

void TrajectoryStream::add(double time, const std::vector<BodyState>& bodies) {
  if (form_ == Form::xyz) {
    append(xyz_frame_of(*scenario_, time, bodies, "reference", top_of(*scenario_, bodies)));
    return;
  }
  write_file_atomically(folder_ / vtk_frame_name(stem_, times_.size()),
                        vtk_frame_of(*scenario_, time, bodies));
  times_.push_back(time);
  write_file_atomically(folder_ / (stem_ + ".pvd"), vtk_collection_of(times_, stem_));
}

void TrajectoryStream::append(const std::string& text) {
  const fs::path path = folder_ / (stem_ + ".xyz");
  std::ofstream file(path, std::ios::binary | (bytes_ == 0 ? std::ios::trunc : std::ios::app));
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) throw WriteFailure(fmt::format("cannot write {}", path.string()));
  bytes_ += text.size();
}

void TrajectoryStream::exchange(StateArchive& archive) {
  archive(bytes_, times_);
  if (!archive.reads() || bytes_ == 0) return;
  const fs::path path = folder_ / (stem_ + ".xyz");
  std::error_code error;
  if (const std::uint64_t there = fs::file_size(path, error); error || there < bytes_)
    throw WriteFailure(
        fmt::format("cannot go on with {}: must hold {} bytes", path.string(), bytes_));
  fs::resize_file(path, bytes_, error);
  if (error) throw WriteFailure(fmt::format("cannot write {}: {}", path.string(), error.message()));
}

}  // namespace slipcheck
