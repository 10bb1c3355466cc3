#include "common/service/param_options.h"

namespace roomwise {

ParamOptions::ParamOptions(CLI::App& app, const ParamFields& params) : fields_(params.fields()) {
  for (const ParamField& field : fields_) {
    app.add_option("--" + field.name, texts_[field.name])
        ->group("Parameters")
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
}

std::vector<ParamSetting> ParamOptions::settings() const {
  std::vector<ParamSetting> settings;
  for (const ParamField& field : fields_) {
    const auto& texts = texts_.at(field.name);
    if (!texts.empty()) settings.push_back({field, texts});
  }
  return settings;
}

}  // namespace roomwise
