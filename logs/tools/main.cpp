// rwlog: looks into, makes, converts and scores logs.
#include <fmt/core.h>

#include "logs/tools/import_oni.h"
#include "logs/tools/smooth.h"
#include "logs/tools/subcommands.h"

namespace {

void add_subcommands(CLI::App& rwlog) {
  using namespace roomwise;
  add_info(rwlog);
  add_csv(rwlog);
  add_cut(rwlog);
  CLI::App& import = *rwlog.add_subcommand("import", "Makes a log of somebody else's recording.");
  import.require_subcommand(1);
  add_import_7scenes(import);
  add_import_tum(import);
  add_import_mrclam(import);
  add_import_fakenect(import);
  add_import_oni(import);
  CLI::App& convert =
      *rwlog.add_subcommand("export", "Makes text, a picture or another format of a log.");
  convert.require_subcommand(1);
  add_export_trajectory(convert);
  add_export_map_png(convert);
  add_export_landmarks_png(convert);
  add_export_labels_png(convert);
  add_export_ply(convert);
  add_export_pcd(convert);
  add_export_mcap(convert);
  add_score(rwlog);
  add_train(rwlog);
  add_smooth(rwlog);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App rwlog{"Looks into, makes, converts and scores logs.", "rwlog"};
  rwlog.require_subcommand(1);
  add_subcommands(rwlog);
  try {
    rwlog.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return rwlog.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "rwlog: {}\n", error.what());
    return 1;
  }
}
