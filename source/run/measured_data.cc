#include <vibrocontact/base/atomic_file.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/run/measured_data.h>
#include <vibrocontact/scene/identified.h>

namespace vibrocontact
{
  PoleFile pole_file(const BodyParameters &body)
  {
    const std::string &file = body.description->measured()->poles_file;
    return read_poles(read_csv(file, read_file_on_all_ranks(file, "poles file")));
  }

  namespace
  {
    /// @param in_contact the points lie over a road
    /// Says which point lies where, too: the file's order decides.
    void check_positions(const BodyParameters &body, const bool in_contact,
                         const std::vector<std::string> &labels, const std::string &file)
    {
      const unsigned int n_points = labels.size();
      const std::vector<double> &places = body.description->measured()->positions;
      if (in_contact && places.empty() && n_points > 1)
        throw InputError(body.name + "/Identified/Positions is not set, but the data \"" + file + "\" have " +
                         std::to_string(n_points) + " points: say where each lies along the road.");
      if (!places.empty() && places.size() != n_points)
        throw InputError(body.name + "/Identified/Positions gives " + std::to_string(places.size()) +
                         " places, but the data \"" + file + "\" have " + std::to_string(n_points) +
                         " points; give one for each.");
      std::string text;
      for (unsigned int i = 0; i < places.size() && in_contact && n_points > 1; ++i)
        text += (i == 0 ? "" : ", ") + labels[i] + " at " + number_text(places[i]) + " m";
      if (!text.empty())
        run_log().line(body.name + ": points in the order of the data, " + text);
    }

    /// @throws InputError for data that create energy, unless they are to be taken so
    DataJudgement judge(const IdentificationParameters &own, const FrequencyData &data)
    {
      const DataJudgement judgement = judge_data(data, own.rolling, own.delay);
      if (!judgement.complaint.empty() && own.passive_data)
        throw InputError("The data \"" + data.file_name + "\" " + judgement.complaint + ".");
      return judgement;
    }
  } // namespace

  std::optional<MeasuredData> measured_data(const Parameters &parameters)
  {
    const Scene &scene = parameters.scene;
    const bool in_contact = scene.any_analysis(&AnalysisType::has_contact) ||
                            scene.runs("modal convolution") || scene.runs("periodic");
    for (const BodyParameters &body : scene.bodies)
    {
      const IdentifiedParameters *const own = body.description->measured();
      if (own && !own->takes_data())
        check_positions(body, in_contact, pole_file(body).names.labels, own->poles_file);
    }
    if (!parameters.has_identification())
      return {};
    const IdentificationParameters &own = parameters.identification;
    MeasuredData measured;
    measured.data = read_frequency_data(own.data_file, read_file_on_all_ranks(own.data_file, "data file"),
                                        own.data_rules());
    measured.judgement = judge(own, measured.data);
    for (const BodyParameters &body : scene.bodies)
      if (body.description->measured() && body.description->measured()->takes_data())
        check_positions(body, in_contact, measured.data.labels, own.data_file);
    return measured;
  }
} // namespace vibrocontact
