// SPDX-License-Identifier: LGPL-3.0-or-later
// The program `locus`: reads a job as JSON, computes it, writes the result as JSON and as a picture.

#include "progress_bar.h"
#include "read_certificate.h"

#include <locus/bisector_2.h>
#include <locus/check/checker.h>
#include <locus/io/certificate.h>
#include <locus/io/json_job.h>
#include <locus/io/json_result.h>
#include <locus/io/svg.h>

#include <CLI/CLI.hpp>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace {

/// What the program's exit status says.
enum Exit : int { answered = 0, something_undecided = 1, invalid_job = 2, internal_error = 3, missing_feature = 4 };

/// The command line or a file it names cannot be used.
class Usage_error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

struct Settings {
  std::string job;
  std::string json, svg, ply, certificate; ///< output files; empty: none
  std::string tolerance;
  bool progress = false;
  std::size_t max_cells = locus::Solve_control().max_cells;
  double max_seconds = std::numeric_limits<double>::infinity();
};

constexpr const char* standard = "-"; // standard input or output

std::string shown(const std::string& path) { return path == standard ? "standard input" : locus::printable(path, 400); }

int complain(const std::string& message, Exit status)
{
  // Whatever the message quotes: one line.
  std::cerr << "locus: " << locus::printable(message, 2000) << std::endl;
  return status;
}

// ---------------------------------------------------------------------------------------------------------- files

std::string system_reason()
{
  return errno == 0 ? std::string("unknown reason") : std::generic_category().message(errno);
}

std::string read_text(const std::string& path)
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

void require_distinct_files(const Settings& settings)
{
  const std::string outputs[] = {settings.json, settings.svg, settings.ply, settings.certificate};
  for (std::size_t i = 0; i < std::size(outputs); ++i) {
    if (outputs[i].empty()) continue;
    if (std::count(std::begin(outputs), std::end(outputs), outputs[i]) > 1)
      throw Usage_error(shown(outputs[i]) + ": named for two outputs; give each its own file");
    std::error_code absent; // a file that is not there yet is no other file
    if (settings.job != standard && outputs[i] != standard &&
        std::filesystem::equivalent(settings.job, outputs[i], absent))
      throw Usage_error(shown(outputs[i]) + ": is the job itself; name another output file");
  }
}

// -------------------------------------------------------------------------------------------------------- the work

std::atomic<bool>* interrupted = nullptr;
static_assert(std::atomic<bool>::is_always_lock_free);

/// The first interrupt ends the solve, whose result then says what is undecided; the second ends the program.
extern "C" void on_interrupt(int signal)
{
  if (interrupted) interrupted->store(true);
  std::signal(signal, SIG_DFL);
}

/// A tolerance as the library takes it: a positive double, at most the inputs' diameter.
double as_double(const locus::Rational& tolerance)
{
  constexpr double least = std::numeric_limits<double>::min();
  return std::min(1.0, std::max(least, locus::nearest_double(tolerance)));
}

locus::Rational tolerance_of(const std::string& text)
{
  std::optional<locus::Rational> value;
  try {
    value = locus::parse_rational(text);
  } catch (const std::invalid_argument& e) {
    throw Usage_error(std::string("--tolerance: ") + e.what() + "; give a positive number like 1e-6");
  }
  if (*value <= 0)
    throw Usage_error("--tolerance: must be positive, not " + text +
                      "; give a small part of the inputs' diameter, like 1e-6");
  return *value;
}

std::vector<locus::Curve_2> curves_of(const locus::Job& job)
{
  std::vector<locus::Curve_2> curves;
  for (const locus::Job_input& input : job.inputs) curves.push_back(*input.curve);
  return curves;
}

/// Of two curves, or of one with itself.
locus::Locus<2> bisector_of(const std::vector<locus::Curve_2>& curves, const locus::Bisector_options& options)
{
  if (curves.size() == 1) return locus::untrimmed_bisector(curves[0], options);
  return locus::untrimmed_bisector(curves[0], curves[1], options);
}

int run(const Settings& settings)
{
  require_distinct_files(settings);
  if (!(settings.max_seconds > 0)) throw Usage_error("--max-seconds: must be positive; leave it out for no limit");
  std::optional<locus::Rational> tolerance;
  if (!settings.tolerance.empty()) tolerance = tolerance_of(settings.tolerance);

  const std::string text = read_text(settings.job);
  const locus::Job job = locus::read_job(text);
  locus::require_supported(job);
  if (!settings.ply.empty()) throw locus::Unsupported_feature("--ply: meshes");

  const bool on_terminal = isatty(STDERR_FILENO) != 0;
  using Style = Progress_bar::Style;
  Progress_bar bar(std::cerr,
                   on_terminal         ? Style::bar
                   : settings.progress ? Style::lines
                                       : Style::none,
                   settings.progress ? 0.0 : 1.0);
  const auto cancel = std::make_shared<std::atomic<bool>>(false);
  interrupted = cancel.get();
  std::signal(SIGINT, on_interrupt);

  locus::Bisector_options options;
  options.control.max_cells = settings.max_cells;
  options.control.max_seconds = settings.max_seconds;
  options.control.cancel = cancel;
  options.control.progress = [&bar](std::size_t done, std::size_t open) { bar.show("cells", done, open); };
  options.keep_cells = !settings.svg.empty();
  options.keep_evidence = !settings.certificate.empty();
  const std::vector<locus::Curve_2> curves = curves_of(job);
  const locus::Locus<2> result = bisector_of(curves, options);
  std::signal(SIGINT, SIG_DFL);
  interrupted = nullptr;

  const double wanted = as_double(tolerance ? *tolerance : job.options.tolerance);
  const std::string json = !settings.json.empty() ? settings.json : settings.svg == standard ? "" : standard;
  // A bar on a terminal must not run into a result on the same terminal.
  std::function<void(std::size_t, std::size_t)> on_arc;
  if (json != standard || !on_terminal || isatty(STDOUT_FILENO) == 0)
    on_arc = [&bar](std::size_t done, std::size_t open) { bar.show("arcs", done, open); };
  else bar.clear();
  locus::Status status = result.status();
  if (!json.empty())
    write_output(json, [&](std::ostream& out) { status = locus::write_json(out, result, wanted, on_arc, curves); });
  bar.clear();
  if (!settings.svg.empty())
    write_output(settings.svg, [&](std::ostream& out) { locus::write_svg(out, result, curves); });
  if (!settings.certificate.empty())
    write_output(settings.certificate, [&](std::ostream& out) { locus::write_certificate(out, result, locus::parse_json(text)); });
  return status == locus::Status::certified ? answered : something_undecided;
}

std::string counted(std::size_t n, const std::string& noun) { return std::to_string(n) + " " + noun + (n == 1 ? "" : "s"); }

/// Verifies a certificate and says what was verified. Throws check::Refused.
int check_certificate(const std::string& path)
{
  const locus::check::Certificate certificate = locus_cli::read_certificate(read_text(path));
  const auto start = std::chrono::steady_clock::now();
  const locus::check::Summary s = locus::check::check(certificate);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::cout << "verified: " << counted(s.patches, "chart") << ", " << counted(s.pairs, "empty pair") << ", " << counted(s.cells, "cell") << ", "
            << counted(s.singular, "singular point") << ", " << counted(s.arcs, "arc");
  if (s.tolerated > 0) std::cout << "; taken as smooth by a tolerance: " << counted(s.tolerated, "joint");
  if (s.undecided > 0) std::cout << "; undecided: " << counted(s.undecided, "place");
  std::cout << "; checked in " << seconds << " s, solved in " << certificate.seconds << " s" << std::endl;
  return s.undecided == 0 ? answered : something_undecided;
}

constexpr const char* footer = R"(
A job is a JSON object, for example
  {"compute": "bisector",
   "inputs": [{"curve": {"degree": 2, "control_points": [[0,0],[1,"3/2"],[2,0]]}},
              {"curve": {"degree": 1, "control_points": [[0,3],[2,2.5]], "weights": [1,2]}}],
   "options": {"trimmed": false, "tolerance": 1e-6}}
Numbers are read exactly: 0.1 is 1/10; strings hold decimals or fractions. One curve alone: its self-bisector.

Exit status: 0 answered; 1 answered, but something is undecided (the result says what); 2 the job is invalid;
3 internal error; 4 valid, but a feature that this version does not have yet.)";

} // namespace

int main(int argc, char** argv)
{
  CLI::App app("locus: certified bisectors of rational curves. Reads a job, writes the result as JSON.", "locus");
  Settings settings;
  std::string certificate_to_check;
  app.set_version_flag("--version", "locus " LOCUS_VERSION, "print the version");
  app.add_option("JOB", settings.job, "the job, a JSON file; - for standard input");
  app.add_option("--json", settings.json, "where the result goes; - or none for standard output")->option_text("OUT");
  app.add_option("--svg", settings.svg, "where a picture goes; - for standard output, instead of the result")
    ->option_text("OUT");
  app.add_option("--ply", settings.ply, "where a mesh goes (surfaces)")->option_text("OUT");
  app.add_option("--certificate", settings.certificate, "where the proof goes")->option_text("OUT");
  app
    .add_option("--tolerance", settings.tolerance,
                "greatest distance between polyline and locus, as a part of the inputs' diameter; wins over the job's")
    ->option_text("E");
  app.add_option("--max-cells", settings.max_cells, "examine at most so many cells")
    ->option_text("N")
    ->check(CLI::PositiveNumber);
  app.add_option("--max-seconds", settings.max_seconds, "solve for at most so long")->option_text("S");
  app.add_flag("--progress", settings.progress, "show the progress from the beginning, also off a terminal");
  CLI::App* check = app.add_subcommand("check", "re-verify a certificate in exact rationals only");
  check->add_option("CERTIFICATE", certificate_to_check, "the file that --certificate wrote")->required();
  app.footer(footer);

  try {
    app.parse(argc, argv);
    if (!check->parsed() && settings.job.empty()) throw CLI::RequiredError("JOB");
  } catch (const CLI::Success& e) { // --help, --version
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return complain(std::string(e.what()) + "; see locus --help", invalid_job);
  }

  const std::string job = shown(settings.job);
  try {
    return check->parsed() ? check_certificate(certificate_to_check) : run(settings);
  } catch (const Usage_error& e) {
    return complain(e.what(), invalid_job);
  } catch (const locus::check::Refused& e) {
    return complain(shown(certificate_to_check) + ": refused: " + e.what(), invalid_job);
  } catch (const locus::Invalid_input& e) {
    return complain((check->parsed() ? shown(certificate_to_check) : job) + ": " + e.what(), invalid_job);
  } catch (const locus::Unsupported_feature& e) {
    return complain((check->parsed() ? "" : job + ": ") + ("not in this version yet: " + std::string(e.what())),
                    missing_feature);
  } catch (const std::exception& e) {
    return complain("internal error: " + std::string(e.what()), internal_error);
  }
}
