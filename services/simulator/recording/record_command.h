#pragma once

namespace roomwise::simulator {

/// True if the command line asks for a drive to be recorded: it holds --record.
bool asks_for_recording(int argc, const char* const* argv);

/// main() of `simulator --record LOG [--path NAME] [--seconds S] [--params FILE] [--PARAMETER
/// ...]`: writes the log as fast as it can and returns the exit status; errors are one line on
/// stderr.
int record_main(int argc, const char* const* argv);

}  // namespace roomwise::simulator
