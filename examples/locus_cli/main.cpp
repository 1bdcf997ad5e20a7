// SPDX-License-Identifier: LGPL-3.0-or-later
// The program `locus`: reads a job as JSON, computes it, writes the result as JSON and as a picture.

#include "files.h"
#include "progress_bar.h"
#include "read_certificate.h"

#include <locus/bisector_2.h>
#include <locus/bisector_3.h>
#include <locus/check/checker.h>
#include <locus/curvature.h>
#include <locus/evolute.h>
#include <locus/io/certificate.h>
#include <locus/io/json_curvature.h>
#include <locus/io/json_job.h>
#include <locus/io/mesh.h>
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

using namespace locus_cli;

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

/// Shows progress and lets the first interrupt stop the work.
class Watched_run {
public:
  explicit Watched_run(const Settings& settings)
    : on_terminal_(isatty(STDERR_FILENO) != 0),
      bar_(std::cerr, on_terminal_ ? Progress_bar::Style::bar : settings.progress ? Progress_bar::Style::lines : Progress_bar::Style::none,
           settings.progress ? 0.0 : 1.0)
  {
    if (settings.max_cells) control.max_cells = *settings.max_cells;
    control.max_seconds = settings.max_seconds;
    control.cancel = std::make_shared<std::atomic<bool>>(false);
    control.progress = [this](std::size_t done, std::size_t open) { bar_.show("cells", done, open); };
    interrupted = control.cancel.get();
    std::signal(SIGINT, on_interrupt);
  }
  Watched_run(const Watched_run&) = delete;
  Watched_run& operator=(const Watched_run&) = delete;
  ~Watched_run() { done(); }

  /// From here on an interrupt ends the program.
  void done()
  {
    std::signal(SIGINT, SIG_DFL);
    interrupted = nullptr;
    bar_.clear();
  }

  /// Progress of what is written; none where a bar on a terminal would run into a result on the same terminal.
  std::function<void(std::size_t, std::size_t)> on_arc(const std::string& json)
  {
    if (json == standard && on_terminal_ && isatty(STDOUT_FILENO) != 0) return {};
    return [this](std::size_t done, std::size_t open) { bar_.show("arcs", done, open); };
  }
  void clear() { bar_.clear(); }

  locus::Solve_control control;

private:
  bool on_terminal_;
  Progress_bar bar_;
};

/// Where the result goes, if anywhere.
std::string json_file(const Settings& settings)
{
  if (!settings.json.empty()) return settings.json;
  for (const std::string& output : settings.outputs())
    if (output == standard) return "";
  return standard;
}

void refuse_outputs(const Settings& settings, bool svg, bool meshes, bool certificate)
{
  if (!svg && !settings.svg.empty()) throw locus::Unsupported_feature("--svg: pictures of what is in space (use --ply, --obj or --vtk)");
  if (!certificate && !settings.certificate.empty()) throw locus::Unsupported_feature("--certificate: certificates of anything but untrimmed planar bisectors of curves");
  const std::pair<const char*, const std::string&> files[] = {{"--ply", settings.ply}, {"--obj", settings.obj}, {"--vtk", settings.vtk}};
  for (const auto& [name, file] : files)
    if (!meshes && !file.empty()) throw locus::Unsupported_feature(std::string(name) + ": meshes of anything but surfaces");
}

int exit_of(locus::Status status) { return status == locus::Status::certified ? answered : something_undecided; }

locus::Locus<2> curve_bisector(const std::vector<locus::Curve_2>& curves, bool trimmed, const locus::Bisector_options& options)
{
  if (trimmed) return curves.size() == 1 ? locus::bisector(curves[0], options) : locus::bisector(curves[0], curves[1], options);
  return curves.size() == 1 ? locus::untrimmed_bisector(curves[0], options) : locus::untrimmed_bisector(curves[0], curves[1], options);
}

/// Of two planar curves, or of one with itself.
int planar_bisector(const Settings& settings, const locus::Job& job, const std::string& text, double tolerance)
{
  refuse_outputs(settings, true, false, !job.options.trimmed);
  std::vector<locus::Curve_2> curves;
  for (const locus::Job_input& input : job.inputs) curves.push_back(*input.curve);
  Watched_run watched(settings);
  locus::Bisector_options options;
  options.control = watched.control;
  options.keep_cells = !settings.svg.empty();
  options.keep_evidence = !settings.certificate.empty();
  const locus::Locus<2> result = curve_bisector(curves, job.options.trimmed, options);
  watched.done();
  locus::Status status = result.status();
  const std::string json = json_file(settings);
  if (!json.empty())
    write_output(json, [&](std::ostream& out) { status = locus::write_json(out, result, tolerance, watched.on_arc(json), curves); });
  watched.clear();
  if (!settings.svg.empty()) write_output(settings.svg, [&](std::ostream& out) { locus::write_svg(out, result, curves); });
  if (!settings.certificate.empty())
    write_output(settings.certificate, [&](std::ostream& out) { locus::write_certificate(out, result, locus::parse_json(text)); });
  return exit_of(status);
}

/// Of a point and a curve, or of two points.
locus::Locus<2> point_bisector(const locus::Job& job, const locus::Solve_control& control)
{
  const auto at = [&](std::size_t i) { return locus::Coordinates_2{(*job.inputs[i].point)[0], (*job.inputs[i].point)[1]}; };
  const bool point_first = job.inputs[0].kind == locus::Job_input::Kind::point;
  if (point_first && job.inputs[1].kind == locus::Job_input::Kind::point) return locus::bisector(at(0), at(1));
  const locus::Coordinates_2 point = at(point_first ? 0 : 1);
  const locus::Curve_2& curve = *job.inputs[point_first ? 1 : 0].curve;
  if (!job.options.trimmed) return point_first ? locus::untrimmed_bisector(point, curve) : locus::untrimmed_bisector(curve, point);
  locus::Point_bisector_options options;
  options.control = control;
  options.beyond_ends = job.options.beyond_ends;
  options.keep_rational = true;
  return point_first ? locus::bisector(point, curve, options) : locus::bisector(curve, point, options);
}

int planar_point_bisector(const Settings& settings, const locus::Job& job, double tolerance)
{
  refuse_outputs(settings, true, false, false);
  Watched_run watched(settings);
  const locus::Locus<2> result = point_bisector(job, watched.control);
  watched.done();
  std::vector<locus::Curve_2> curves;
  std::vector<locus::Exact_point<2>> points;
  for (const locus::Job_input& input : job.inputs)
    if (input.curve) curves.push_back(*input.curve);
    else points.push_back({(*input.point)[0], (*input.point)[1]});
  locus::Status status = result.status();
  const std::string json = json_file(settings);
  if (!json.empty())
    write_output(json, [&](std::ostream& out) { status = locus::write_json(out, result, tolerance, watched.on_arc(json), curves); });
  watched.clear();
  if (!settings.svg.empty()) write_output(settings.svg, [&](std::ostream& out) { locus::write_svg(out, result, curves, {}, points); });
  return exit_of(status);
}

/// Names the input of which a computation says that it cannot be done yet.
template <class Compute>
auto of_first_input(Compute compute)
{
  try {
    return compute();
  } catch (const locus::Unsupported_feature& e) {
    throw locus::Unsupported_feature("inputs[0]: " + std::string(e.what()));
  }
}

int planar_curvature(const Settings& settings, const locus::Job& job, double tolerance)
{
  refuse_outputs(settings, true, false, false);
  const locus::Curve_2& curve = *job.inputs[0].curve;
  const locus::Locus<2> evolute = of_first_input([&] { return locus::evolute(curve); });
  const auto analysis = of_first_input([&] { return locus::analyse_curvature(curve); });
  const bool wants_evolute = job.compute == "evolute";
  locus::Status status = wants_evolute ? evolute.status() : locus::Status::certified;
  for (const auto& arc : evolute.arcs())
    if (wants_evolute && !std::isfinite(arc.polyline(tolerance).error())) status = locus::Status::undecided;
  if (const std::string json = json_file(settings); !json.empty())
    write_output(json, [&](std::ostream& out) {
      if (wants_evolute) locus::write_json(out, evolute, tolerance, {}, {curve});
      else locus::write_json(out, analysis, {curve});
    });
  if (!settings.svg.empty())
    write_output(settings.svg, [&](std::ostream& out) { locus::write_svg(out, evolute, {curve}, analysis.points); });
  return exit_of(status);
}

int space_curvature(const Settings& settings, const locus::Job& job, double tolerance)
{
  refuse_outputs(settings, false, false, false);
  const locus::Curve_3& curve = *job.inputs[0].space_curve;
  if (job.compute == "curvature") {
    const auto analysis = of_first_input([&] { return locus::analyse_curvature(curve); });
    write_output(json_file(settings), [&](std::ostream& out) { locus::write_json(out, analysis, {curve}); });
    return answered;
  }
  const locus::Locus<3> evolute = of_first_input([&] { return locus::evolute(curve); });
  locus::Status status = evolute.status();
  write_output(json_file(settings), [&](std::ostream& out) { status = locus::write_json(out, evolute, tolerance, {}, {curve}); });
  return exit_of(status);
}

locus::Exact_point<3> space_point(const locus::Job_input& input) { return {(*input.point)[0], (*input.point)[1], (*input.point)[2]}; }

/// Of inputs in space whose bisector is rational, as `require_supported` lets them through.
locus::Locus<3> bisector_in_space(const locus::Job_input& a, const locus::Job_input& b, const locus::Mesh_options& options, bool trimmed)
{
  if (a.point && b.point && trimmed) return locus::bisector(space_point(a), space_point(b), options);
  if (a.point && b.point) return locus::untrimmed_bisector(space_point(a), space_point(b), options);
  if (!a.point && b.point) return bisector_in_space(b, a, options, trimmed);
  if (!a.point) return locus::untrimmed_bisector(*a.space_curve, *b.space_curve, options);
  if (b.surface) return locus::untrimmed_bisector(space_point(a), *b.surface, options);
  return locus::untrimmed_bisector(space_point(a), *b.space_curve, options);
}

int space_bisector(const Settings& settings, const locus::Job& job, double tolerance)
{
  refuse_outputs(settings, false, true, false);
  Watched_run watched(settings);
  locus::Mesh_options options;
  options.tolerance = tolerance;
  if (settings.max_cells) options.max_cells = *settings.max_cells;
  options.control = watched.control;
  const locus::Locus<3> result = [&] {
    try {
      return bisector_in_space(job.inputs[0], job.inputs[1], options, job.options.trimmed);
    } catch (const locus::Invalid_input& e) {
      throw e.within("inputs[1]"); // one point twice
    } catch (const locus::Unsupported_feature& e) {
      throw locus::Unsupported_feature("inputs: " + std::string(e.what()));
    }
  }();
  watched.done();
  if (const std::string json = json_file(settings); !json.empty())
    write_output(json, [&](std::ostream& out) { locus::write_json(out, result, tolerance); });
  if (!settings.ply.empty()) write_output(settings.ply, [&](std::ostream& out) { locus::write_ply(out, result.sheets()); });
  if (!settings.obj.empty()) write_output(settings.obj, [&](std::ostream& out) { locus::write_obj(out, result.sheets()); });
  if (!settings.vtk.empty()) write_output(settings.vtk, [&](std::ostream& out) { locus::write_vtk(out, result.sheets()); });
  return exit_of(result.status());
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
  if (!tolerance && job.options.has_tolerance) tolerance = job.options.tolerance;
  const bool planar = job.inputs[0].dimension == 2;
  const double wanted = tolerance ? as_double(*tolerance) : planar || job.compute != "bisector" ? 1e-6 : locus::Mesh_options().tolerance;
  if (job.compute != "bisector") return planar ? planar_curvature(settings, job, wanted) : space_curvature(settings, job, wanted);
  if (!planar) return space_bisector(settings, job, wanted);
  const bool has_point = std::any_of(job.inputs.begin(), job.inputs.end(), [](const locus::Job_input& i) { return i.kind == locus::Job_input::Kind::point; });
  return has_point ? planar_point_bisector(settings, job, wanted) : planar_bisector(settings, job, text, wanted);
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
"compute" may also be "curvature" or "evolute", of one curve. Points have two or three coordinates; in space bisectors are
those of points, of a point and a curve or a surface, and of two curves.

Exit status: 0 answered; 1 answered, but something is undecided (the result says what); 2 the job is invalid;
3 internal error; 4 valid, but a feature that this version does not have yet.)";

} // namespace

int main(int argc, char** argv)
{
  CLI::App app("locus: certified bisectors and curvature of rational curves. Reads a job, writes the result as JSON.", "locus");
  Settings settings;
  std::string certificate_to_check;
  app.set_version_flag("--version", "locus " LOCUS_VERSION, "print the version");
  app.add_option("JOB", settings.job, "the job, a JSON file; - for standard input");
  app.add_option("--json", settings.json, "where the result goes; - or none for standard output")->option_text("OUT");
  app.add_option("--svg", settings.svg, "where a picture goes; - for standard output, instead of the result")
    ->option_text("OUT");
  app.add_option("--ply", settings.ply, "where a mesh goes (surfaces)")->option_text("OUT");
  app.add_option("--obj", settings.obj, "the same as OBJ")->option_text("OUT");
  app.add_option("--vtk", settings.vtk, "the same as VTK, with parameters and radius")->option_text("OUT");
  app.add_option("--certificate", settings.certificate, "where the proof goes")->option_text("OUT");
  app
    .add_option("--tolerance", settings.tolerance,
                "greatest distance between polyline or mesh and locus, as a part of the inputs' diameter; wins over the job's")
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
