#pragma once
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace roomwise {

/// One parameter of a service: where its value lives and which values it may take.
struct ParamField {
  template <class T>
  struct Range {
    T* value;
    T smallest;
    T largest;
  };
  struct Choice {
    std::string* value;
    std::vector<std::string> allowed;  ///< empty: any text
  };
  std::string name;
  std::variant<Range<double>, Range<int>, bool*, Choice, std::vector<std::string>*> slot;
};

/// Collects the fields a parameter struct names in its visit_fields:
///
///   template <class Field> void visit_fields(Field&& field) {
///     field("range_noise_m", range_noise_m, 1e-3, 1.0);          // smallest, largest
///     field("rows_min", rows_min, 1, 480);
///     field("publish_edges", publish_edges);
///     field("method", method, {"thesis", "disparity"});
///     field("fault", fault);                                     // a list of texts
///   }
class ParamFields {
 public:
  template <class Params>
  explicit ParamFields(Params& params) {
    params.visit_fields(*this);
  }
  void operator()(std::string_view name, double& value, double smallest, double largest) {
    fields_.push_back({std::string(name), ParamField::Range<double>{&value, smallest, largest}});
  }
  void operator()(std::string_view name, int& value, int smallest, int largest) {
    fields_.push_back({std::string(name), ParamField::Range<int>{&value, smallest, largest}});
  }
  void operator()(std::string_view name, bool& value) {
    fields_.push_back({std::string(name), &value});
  }
  void operator()(std::string_view name, std::string& value,
                  std::initializer_list<const char*> allowed = {}) {
    fields_.push_back(
        {std::string(name),
         ParamField::Choice{&value, std::vector<std::string>(allowed.begin(), allowed.end())}});
  }
  void operator()(std::string_view name, std::vector<std::string>& values) {
    fields_.push_back({std::string(name), &values});
  }
  const std::vector<ParamField>& fields() const { return fields_; }

 private:
  std::vector<ParamField> fields_;
};

/// Overwrites fields with the values of a TOML text. Strict: throws std::runtime_error
/// "source:line: name must be ..." on a key no field has, a wrong type, a value out of range or
/// text that is not TOML; the fields are then as they were.
void apply_toml(std::string_view toml, std::string_view source, const ParamFields& fields);

/// Overwrites one field with what a command line says of it: one text, or several for a list.
/// Throws as apply_toml.
void apply_text(const ParamField& field, const std::vector<std::string>& texts,
                const ParamFields& fields);

/// The values in force as a TOML text that apply_toml reads back exactly.
std::string to_toml(const ParamFields& fields);

/// Defaults of `Params`, overridden by the file at `path` if it is not empty.
/// Throws std::runtime_error as apply_toml, and if the file cannot be read.
void load_params_file(const std::filesystem::path& path, const ParamFields& fields);

template <class Params>
Params load_params(const std::filesystem::path& path) {
  Params params;
  if (!path.empty()) load_params_file(path, ParamFields(params));
  return params;
}

}  // namespace roomwise
