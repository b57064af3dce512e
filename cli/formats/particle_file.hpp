#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/diagnostics/fields.hpp"

namespace taut::cli {

/// Compressed VTK PolyData (.vtp), with z = 0 in 2D. `single_precision`: real numbers except the time are Float32.
std::string particle_file_text(const Snapshot& snapshot, std::span<const Field* const> fields,
                               bool single_precision = false);

/// Reader of a .vtp file of taut. Throws UsageError.
class ParticleFile {
 public:
  explicit ParticleFile(std::filesystem::path path);

  double time() const { return time_; }  // s
  std::size_t size() const { return size_; }
  std::vector<std::string> fields() const;  // in file order
  bool has(const std::string& field) const;
  std::vector<double> positions(int dim) const;  // n × dim, m
  std::vector<double> diameter() const;          // m
  std::vector<double> field(const std::string& key) const;

 private:
  struct Array {
    std::string name, type;
    std::size_t components = 1;
    std::uint64_t offset = 0;
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
