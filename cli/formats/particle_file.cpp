#include "cli/formats/particle_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numeric>
#include <optional>
#include <utility>

#include "cli/formats/particle_arrays.hpp"
#include "cli/formats/zlib_blocks.hpp"
#include "cli/text/format.hpp"
#include "cli/text/shown.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

constexpr std::string_view points_name = "Points";
constexpr std::string_view diameter_name = "diameter";
constexpr std::string_view velocity_name = "velocity";
constexpr std::string_view stress_name = "stress";
constexpr std::array no_fields{diameter_name, std::string_view("held"), std::string_view("id"),
                               std::string_view("mass"), std::string_view("volume")};
constexpr std::string_view time_name = "TimeValue";  // for ParaView
constexpr std::size_t most_particles = 20'000'000;   // as in a scene
constexpr std::string_view data_begin = "<AppendedData encoding=\"raw\">\n_";

std::string attribute(std::string_view key, std::string_view value) {
  std::string text(" ");
  return text.append(key).append("=\"").append(value).append("\"");
}

class Writer {
 public:
  void line(std::string_view text) { (xml_ += text) += '\n'; }

  template <class Number>
  void array(std::string_view name, std::string_view type, const std::vector<Number>& values,
             std::span<const std::string_view> components = {}) {
    std::string tag =
        "<DataArray" + attribute("type", type) + attribute("Name", name) +
        attribute("NumberOfComponents", std::to_string(std::max<std::size_t>(components.size(), 1)));
    if (components.size() == tensor_components().size())
      for (std::size_t k = 0; k < components.size(); ++k)
        tag += attribute("ComponentName" + std::to_string(k), components[k]);
    line(tag + attribute("format", "appended") + attribute("offset", std::to_string(data_.size())) + "/>");
    data_ += to_zlib_blocks(std::as_bytes(std::span(values)));
  }

  std::string text() && {
    return std::move(xml_) + std::string(data_begin) + data_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  std::string xml_, data_;
};

template <class Number>
void add_as(Writer& file, std::string_view type, const ParticleArray& array) {
  file.array(array.name, type, std::vector<Number>(array.values.begin(), array.values.end()),
             array.components);
}

void add(Writer& file, const ParticleArray& array, bool single_precision) {
  using Type = ParticleArray::Type;
  if (array.type == Type::flag) return add_as<std::uint8_t>(file, "UInt8", array);
  if (array.type == Type::whole) return add_as<std::int32_t>(file, "Int32", array);
  if (single_precision) return add_as<float>(file, "Float32", array);
  file.array(array.name, "Float64", array.values, array.components);
}

void write_point_data(Writer& file, const std::vector<ParticleArray>& arrays, bool single_precision) {
  // arrays that ParaView shows first
  const bool has_field = arrays.front().name != diameter_name;
  const bool has_tensor = std::ranges::count(arrays, stress_name, &ParticleArray::name) > 0;
  file.line("<PointData" + (has_field ? attribute("Scalars", arrays.front().name) : "") +
            attribute("Vectors", velocity_name) + (has_tensor ? attribute("Tensors", stress_name) : "") +
            ">");
  for (const ParticleArray& array : arrays) add(file, array, single_precision);
  file.line("</PointData>");
}

/// One cell per particle, for ParaView.
void write_vertices(Writer& file, std::size_t count) {
  std::vector<std::int32_t> number(count);
  std::iota(number.begin(), number.end(), 0);
  file.line("<Verts>");
  file.array("connectivity", "Int32", number);
  for (std::int32_t& end : number) ++end;
  file.array("offsets", "Int32", number);
  file.line("</Verts>");
}

std::optional<std::string_view> value_of(std::string_view tag, std::string_view key) {
  const std::string opening = std::string(" ").append(key).append("=\"");
  const std::size_t at = tag.find(opening);
  if (at == std::string_view::npos) return std::nullopt;
  tag.remove_prefix(at + opening.size());
  return tag.substr(0, tag.find('"'));
}

template <class Number>
std::optional<Number> number(std::optional<std::string_view> text) {
  return text ? parsed<Number>(*text) : std::nullopt;
}

std::vector<std::string_view> tags_of(std::string_view xml) {
  std::vector<std::string_view> tags;
  for (std::size_t at = xml.find('<'); at != std::string_view::npos; at = xml.find('<', at + 1))
    tags.push_back(xml.substr(at, xml.find('<', at + 1) - at));
  return tags;
}

/// At most 64 KiB, else "".
std::string header_of(std::ifstream& file) {
  std::string text(1 << 16, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  const std::size_t end = text.find(data_begin);
  return end == std::string::npos ? "" : text.substr(0, end + data_begin.size());
}

}  // namespace

std::string particle_file_text(const Snapshot& snapshot, std::span<const Field* const> fields,
                               bool single_precision) {
  const std::string count = std::to_string(snapshot.size());
  Writer file;
  file.line("<?xml version=\"1.0\"?>");
  file.line("<VTKFile" + attribute("type", "PolyData") + attribute("version", "1.0") +
            attribute("byte_order", "LittleEndian") + attribute("header_type", "UInt64") +
            attribute("compressor", "vtkZLibDataCompressor") + ">\n<PolyData>\n<FieldData>");
  file.line("<DataArray type=\"Float64\"" + attribute("Name", time_name) + " NumberOfTuples=\"1\" " +
            "format=\"ascii\">" + exact(snapshot.time) + "</DataArray>\n</FieldData>");
  file.line("<Piece" + attribute("NumberOfPoints", count) + attribute("NumberOfVerts", count) + ">");
  write_point_data(file, particle_arrays(snapshot, fields), single_precision);
  file.line("<Points>");
  add(file, position_array(snapshot), single_precision);
  file.line("</Points>");
  write_vertices(file, snapshot.size());
  file.line("</Piece>\n</PolyData>");
  return std::move(file).text();
}

ParticleFile::ParticleFile(std::filesystem::path path) : path_(std::move(path)) { read_header(); }

void ParticleFile::read_header() {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path_, error))
    fail("is not a regular file");  // opening a pipe would wait
  std::ifstream file(path_, std::ios::binary);
  if (!file) fail("cannot be read");
  const std::string header = header_of(file);
  std::optional<double> time;
  std::optional<std::size_t> size;
  for (const std::string_view tag : tags_of(header)) {
    if (tag.starts_with("<Piece")) size = number<std::size_t>(value_of(tag, "NumberOfPoints"));
    if (tag.starts_with("<Verts")) break;
    if (!tag.starts_with("<DataArray")) continue;
    const std::string_view name = value_of(tag, "Name").value_or("");
    if (name == time_name) time = number<double>(tag.substr(tag.find('>') + 1));
    const auto type = value_of(tag, "type");
    const auto components = number<std::size_t>(value_of(tag, "NumberOfComponents"));
    if (const auto offset = number<std::uint64_t>(value_of(tag, "offset")); offset && type && components) {
      if (find(std::string(name))) fail("has two arrays with the name '" + shown(name) + "'");
      arrays_.push_back({std::string(name), std::string(*type), *components, header.size() + *offset});
    }
  }
  const auto has_numbers = [&](std::string_view name, std::size_t components) {
    const Array* const array = find(std::string(name));
    return array && array->components == components;
  };
  if (!time || !size || !has_numbers(points_name, 3) || !has_numbers(diameter_name, 1))
    fail("is not a particle file of taut");
  if (!std::isfinite(*time)) fail("has a time that is not a finite number");
  if (*size > most_particles)
    fail("declares " + std::to_string(*size) + " particles; at most 20 million are allowed");
  time_ = *time;
  size_ = *size;
}

const ParticleFile::Array* ParticleFile::find(const std::string& name) const {
  const auto found = std::ranges::find(arrays_, name, &Array::name);
  return found == arrays_.end() ? nullptr : &*found;
}

std::vector<double> ParticleFile::read(const Array& array) const {
  if (array.type == "Float64") return read_as<double>(array);
  if (array.type == "Float32") return read_as<float>(array);
  if (array.type == "Int32") return read_as<std::int32_t>(array);
  if (array.type == "UInt8") return read_as<std::uint8_t>(array);
  fail("stores " + array.name + " as " + array.type + ", which taut never writes");
}

template <class Number>
std::vector<double> ParticleFile::read_as(const Array& array) const {
  std::ifstream file(path_, std::ios::binary | std::ios::ate);
  const auto length =
      static_cast<std::uint64_t>(std::max<std::streamoff>(file ? std::streamoff(file.tellg()) : 0, 0));
  // zlib compresses about 1000-fold at most; damaged sizes must not allocate memory
  constexpr std::uint64_t most_packed = 1024;
  if (array.offset >= length || array.components > 9 ||
      array.components * size_ * sizeof(Number) > most_packed * (length - array.offset))
    fail("is truncated or damaged");
  const std::size_t count = array.components * size_;
  std::string packed(std::min<std::uint64_t>(length - array.offset, 64 + 2 * sizeof(Number) * (count + 4096)),
                     '\0');
  file.seekg(static_cast<std::streamoff>(array.offset));
  file.read(packed.data(), static_cast<std::streamsize>(packed.size()));
  std::vector<Number> numbers(count);
  if (!file || !from_zlib_blocks(packed, std::as_writable_bytes(std::span(numbers))))
    fail("is truncated or damaged");
  return {numbers.begin(), numbers.end()};
}

std::vector<std::string> ParticleFile::fields() const {
  std::vector<std::string> names;
  for (const Array& array : arrays_)
    if (array.components == 1 && std::ranges::count(no_fields, array.name) == 0) names.push_back(array.name);
  return names;
}

bool ParticleFile::has(const std::string& field) const { return std::ranges::count(fields(), field) > 0; }

std::vector<double> ParticleFile::positions(int dim) const {
  const std::vector<double> points = read(*find(std::string(points_name)));
  const auto stride = static_cast<std::size_t>(dim);
  std::vector<double> x(stride * size_);
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t k = 0; k < stride; ++k) x[stride * i + k] = points[3 * i + k];
  return x;
}

std::vector<double> ParticleFile::diameter() const { return read(*find(std::string(diameter_name))); }

std::vector<double> ParticleFile::field(const std::string& key) const {
  if (!has(key)) fail("does not contain the field " + key + "; it contains " + join(fields()));
  return read(*find(key));
}

void ParticleFile::fail(const std::string& reason) const { throw UsageError(path_.string() + " " + reason); }

}  // namespace taut::cli
