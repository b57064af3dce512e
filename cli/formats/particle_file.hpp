#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/diagnostics/fields.hpp"

namespace taut::cli {

/// The particles of one time as a VTK PolyData file (.vtp) that ParaView opens: positions (z = 0 in 2D), a
/// vertex each, the time, `fields` by key, diameter, velocity (a vector), body and material (numbers from 0)
/// and whether each is held, compressed; what is measured is in double precision.
std::string particle_file_text(const Snapshot& snapshot, std::span<const Field* const> fields);

/// Reads back what `particle_file_text` has written; an array is read when it is asked for.
class ParticleFile {
 public:
  /// Reads the names. UsageError if there is no such file, or it is none of these.
  explicit ParticleFile(std::filesystem::path path);

  double time() const { return time_; }       // s
  std::size_t size() const { return size_; }  // particles
  std::vector<std::string> fields() const;    // keys, in the order of the file, of one number each
  bool has(const std::string& field) const;
  std::vector<double> positions(int dim) const;  // n × dim, m
  std::vector<double> diameter() const;          // m
  /// UsageError, naming those there are, if the field was not saved.
  std::vector<double> field(const std::string& key) const;

 private:
  struct Array {
    std::string name, type;
    std::size_t components = 1;
    std::uint64_t offset = 0;  // from the beginning of the file
  };
  void read_header();
  const Array* find(const std::string& name) const;
  std::vector<double> read(const Array& array) const;
  template <class Number>
  std::vector<double> read_as(const Array& array) const;
  [[noreturn]] void fail(const std::string& reason) const;

  std::filesystem::path path_;
  double time_ = 0;
  std::size_t size_ = 0;
  std::vector<Array> arrays_;
};

}  // namespace taut::cli
