// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef LOCUS_CLI_FILES_H
#define LOCUS_CLI_FILES_H

// The program's settings, the files that they name, and how it complains.

#include <locus/io/json_job.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

namespace locus_cli {

/// What the program's exit status says.
enum Exit : int { answered = 0, something_undecided = 1, invalid_job = 2, internal_error = 3, missing_feature = 4 };

/// The command line or a file it names cannot be used.
class Usage_error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

struct Settings {
  std::string job;
  std::string json, svg, ply, obj, vtk, certificate; ///< output files; empty: none

  std::array<std::string, 6> outputs() const { return {json, svg, ply, obj, vtk, certificate}; }
  std::string tolerance;
  bool progress = false;
  std::optional<std::size_t> max_cells; ///< else each computation's own limit
  double max_seconds = std::numeric_limits<double>::infinity();
};

inline constexpr const char* standard = "-"; // standard input or output

inline std::string shown(const std::string& path) { return path == standard ? "standard input" : locus::printable(path, 400); }

inline int complain(const std::string& message, Exit status)
{
  // Whatever the message quotes: one line.
  std::cerr << "locus: " << locus::printable(message, 2000) << std::endl;
  return status;
}

// ---------------------------------------------------------------------------------------------------------- files

inline std::string system_reason()
{
  return errno == 0 ? std::string("unknown reason") : std::generic_category().message(errno);
}

inline std::string read_text(const std::string& path)
{
  if (path == standard) return locus::read_json_text(std::cin);
  std::error_code ignored; // a path that cannot be examined cannot be opened either, and that is reported
  if (std::filesystem::is_directory(path, ignored))
    throw Usage_error(shown(path) + ": is a directory; name a job file");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw Usage_error(shown(path) + ": cannot be read (" + system_reason() +
                      "); name a job file, or - for standard input");
  std::string text = locus::read_json_text(in);
  if (in.bad())
    throw Usage_error(shown(path) + ": cannot be read (" + system_reason() +
                      "); name a job file, or - for standard input");
  return text;
}

template <class Write>
void write_output(const std::string& path, Write write)
{
  errno = 0;
  if (path == standard) {
    write(std::cout);
    std::cout.flush();
    if (!std::cout)
      throw Usage_error("standard output: cannot be written (" + system_reason() + "); name an output file");
    return;
  }
  std::ofstream out(path, std::ios::binary);
  bool good = out.good();
  if (good) {
    write(out);
    out.close();
    good = out.good();
  }
  if (!good)
    throw Usage_error(shown(path) + ": cannot be written (" + system_reason() +
                      "); name a file in a folder that you may write to");
}

inline void require_distinct_files(const Settings& settings)
{
  const auto outputs = settings.outputs();
  for (const std::string& output : outputs) {
    if (output.empty()) continue;
    if (std::count(outputs.begin(), outputs.end(), output) > 1)
      throw Usage_error(shown(output) + ": named for two outputs; give each its own file");
    std::error_code absent; // a file that is not there yet is no other file
    if (settings.job != standard && output != standard && std::filesystem::equivalent(settings.job, output, absent))
      throw Usage_error(shown(output) + ": is the job itself; name another output file");
  }
}

} // namespace locus_cli

#endif
