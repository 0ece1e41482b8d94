#pragma once

#include <vibrocontact/analyses/modal_convolution/modal_convolution.h>
#include <vibrocontact/base/row_file.h>
#include <vibrocontact/marching/recorder.h>
#include <vibrocontact/marching/signal_output.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Of contact k of a list: its points among all, impulses over them.
  nlohmann::ordered_json contact_json(const PlacedContacts &contacts, unsigned int k,
                                      const ModalConvolutionResult &result, bool with_friction);

  /// Histories of a modal convolution: histories.h5 (beside a transient modal_convolution_histories.h5) with one array per column, `time_s`, then per contact point
  /// `point_<i>_displacement_m`, `point_<i>_force_N`, `point_<i>_road_m`, with friction also `point_<i>_tangential_displacement_m`,
  /// `point_<i>_tangential_force_N`. A line every history interval.
  class ModalConvolutionHistory : public Recorder
  {
  public:
    /// @param file without its .h5
    ModalConvolutionHistory(const ModalConvolutionParameters &parameters, unsigned int n_points,
                            const std::string &file);
    void add(const ModalConvolutionLines &lines);
    void exchange(CheckpointFile &file) override;
    void finish(bool at_the_end) override { rows.finish(at_the_end); }

  private:
    /// every how many steps there is a line
    const unsigned long every;
    const bool friction;
    RowFile rows;
    std::vector<double> row;
  };

  /// The histories as contact_point_<i>.csv: time_s, displacement_m, force_N, road_m, with friction also
  /// tangential_displacement_m, tangential_force_N. @param histories file without its .h5 @throws OutputError
  void write_point_tables(const std::string &histories, unsigned int n_points, bool friction,
                          const std::string &folder);

  /// Forces of all points together, from the histories: normal_force and, with friction, tangential_force. Impulses of the
  /// event-located motion stand in the nearest line as force over the lines' distance.
  std::vector<NamedSignal> recorded_forces(const ModalConvolutionParameters &parameters,
                                           const ModalConvolutionResult &result,
                                           const std::string &histories);

  /// analyses.modal_convolution of results.json; of more events than fit there (10,000) the first.
  nlohmann::ordered_json modal_convolution_json(const ModalConvolutionParameters &parameters,
                                                const ModalConvolutionResult &result);
  /// impacts.csv: time_s, point, impulse_Ns, all of them.
  void write_impacts(const ModalConvolutionResult &result, const std::string &folder);

  /// What the terminal ends with about analyses.modal_convolution of results.json, see Answer.
  std::vector<std::string> modal_convolution_answer(const nlohmann::ordered_json &run);
} // namespace vibrocontact
