#pragma once
#include <CLI/CLI.hpp>

namespace roomwise {

// One function a subcommand: adds it, with its options, to `parent`. What it does runs while the
// command line is parsed; it throws std::runtime_error, naming the file, when it cannot.

void add_info(CLI::App& parent);
void add_csv(CLI::App& parent);
void add_cut(CLI::App& parent);
void add_import_7scenes(CLI::App& parent);
void add_import_tum(CLI::App& parent);
void add_import_mrclam(CLI::App& parent);
void add_import_fakenect(CLI::App& parent);
void add_export_trajectory(CLI::App& parent);
void add_export_map_png(CLI::App& parent);
void add_export_landmarks_png(CLI::App& parent);
void add_export_labels_png(CLI::App& parent);
void add_export_ply(CLI::App& parent);
void add_export_pcd(CLI::App& parent);
void add_export_mcap(CLI::App& parent);
void add_score(CLI::App& parent);
void add_train(CLI::App& parent);

}  // namespace roomwise
