#pragma once

#include <vibrocontact/output/results.h>
#include <vibrocontact/run/analysis.h>
#include <vibrocontact/run/measured_data.h>
#include <vibrocontact/run/prepare_bodies.h>

#include <string>

namespace vibrocontact
{
  /// The analysis `modal convolution` of body 1 on the road, with its output: results, histories.h5, a table per contact
  /// point (up to ten), impacts.csv, checkpoints as the transient's (modal_convolution.h5); with
  /// Comparison/Rows method_comparison.csv. Every rank steps, rank 0 writes. Collective.
  /// @param resume continue from the checkpoint in the folder; from the beginning if there is none
  void run_modal_convolution(const Parameters &parameters, const MeshedBodies &bodies,
                             const std::optional<MeasuredData> &measured, const std::string &folder,
                             bool resume, Results &results);

  /// Its row of the table of analyses.
  Analysis modal_convolution_analysis();
} // namespace vibrocontact
