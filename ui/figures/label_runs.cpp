#include "ui/figures/label_runs.h"

#include <optional>

namespace helical::figures {
namespace {

/// When each tick ends.
std::vector<double> tickEnds(const std::vector<TraceSample>& samples) {
  std::vector<double> ends;
  for (std::size_t i = 1; i < samples.size(); ++i) ends.push_back(samples[i].time_s);
  if (samples.empty()) return ends;
  const double last = samples.back().time_s;
  ends.push_back(samples.size() > 1 ? 2.0 * last - samples[samples.size() - 2].time_s : last);
  return ends;
}

}  // namespace

std::vector<LabelRun> labelRuns(const FlightTrace& trace) {
  const std::vector<double> ends = tickEnds(trace.samples);
  std::vector<LabelRun> runs;
  for (int camera = 0; camera < trace.camera_count; ++camera) {
    for (int marker = 0; marker < trace.marker_count; ++marker) {
      std::optional<LabelRun> run;
      for (std::size_t i = 0; i < trace.samples.size(); ++i) {
        const TraceSample& sample = trace.samples[i];
        const bool selected = (sample.selected[static_cast<std::size_t>(camera)] >> marker & 1u) != 0;
        if (selected && !run) run = LabelRun{trace.marker_count * camera + marker, sample.time_s, 0.0};
        if (selected) run->to_s = ends[i];
        if (run && !selected) {
          runs.push_back(*run);
          run.reset();
        }
      }
      if (run) runs.push_back(*run);
    }
  }
  return runs;
}

}  // namespace helical::figures
