#include <vibrocontact/analyses/frequency_response/run_frequency_response.h>
#include <vibrocontact/analyses/identification/identification.h>
#include <vibrocontact/analyses/modal_convolution/modal_convolution.h>
#include <vibrocontact/analyses/periodic/make_forced_body.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/bodies/band_limited.h>
#include <vibrocontact/fe/surface_assembly.h>
#include <vibrocontact/marching/check_drive.h>
#include <vibrocontact/marching/hub_motion.h>
#include <vibrocontact/marching/initial_state.h>
#include <vibrocontact/marching/probes.h>
#include <vibrocontact/numerics/lsce.h>
#include <vibrocontact/reduction/surface_shapes.h>
#include <vibrocontact/run/check_before_run.h>
#include <vibrocontact/run/check_loading.h>
#include <vibrocontact/run/check_transient.h>
#include <vibrocontact/run/road_body.h>
#include <vibrocontact/scene/identified.h>
#include <vibrocontact/scene/wheel.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace vibrocontact
{
  namespace
  {
    /// Radii of a wheel and where its rim begins.
    void check_rim(const Parameters &parameters)
    {
      for (const BodyParameters &body : parameters.scene.bodies)
      {
        if (!body.description->is_wheel() || !parameters.modes.at(body.name).any())
          continue;
        const SectionOutline outline = *body.description->wheel_section();
        double least = 1e300, most = 0;
        for (const SectionOutline::Row &row : outline.rows)
          for (const double radius : {row.start[1], row.end[1]})
          {
            least = std::min(least, radius);
            most = std::max(most, radius);
          }
        const double rim = rim_radius(body, parameters.modes.at(body.name));
        if (!(least < rim && rim < most))
          throw InputError(body.name + "/Modes/Rim radius is " + number_text(rim) +
                           " m, which is not inside the wheel (radii " + number_text(least) + " to " +
                           number_text(most) + " m): set it to the radius where the rim begins.");
      }
    }

    /// The inverse transforms of data, which need lines from 0 Hz on.
    void check_data(const Parameters &parameters, const std::optional<MeasuredData> &measured)
    {
      if (!measured)
        return;
      const IdentificationParameters &own = parameters.identification;
      bool transformed = false;
      for (const BodyParameters &body : parameters.scene.bodies)
        transformed =
            transformed || (body.description->measured() && body.description->measured()->inverse_transform);
      const std::vector<FitMethod> methods = own.method_list();
      const bool by_impulses =
          std::any_of(methods.begin(), methods.end(),
                      [](const FitMethod &method) { return method.reads_impulse_responses; });
      if (!transformed && !by_impulses)
        return;
      const FrequencyData &data = measured->data;
      if (by_impulses && !transformed)
        impulse_responses(spectra(data), 0);
      if (transformed)
        band_limited_model(spectra(data), entry_map(data));
    }

    bool has_poles_at_hand(const BodyParameters &body)
    {
      if (const IdentifiedParameters *const measured = body.description->measured())
        return !measured->takes_data() || measured->inverse_transform;
      return body.description->at_points() != nullptr;
    }

    void check_modal_convolution(const Parameters &parameters, const MeshedBodies &bodies,
                                 const std::optional<MeasuredData> &measured)
    {
      const BodyParameters &body = parameters.scene.bodies[0];
      ModalConvolutionParameters own = parameters.modal_convolution;
      if (!has_poles_at_hand(body))
      {
        // its points, as high as a flat road
        std::vector<double> places = body.description->places();
        if (places.empty())
          places = places_on_road(parameters);
        const Road road(parameters.road, places, std::vector<double>(places.size(), 0.), own.end_time);
        return;
      }
      const RoadBody made =
          road_body(parameters, bodies, measured, 0, {own.friction, parameters.road.speed, own.time_step});
      const BodyInContact poles = by_poles(made.body);
      const Road road(road_of(parameters, made), made.places, made.shapes, own.end_time);
      own.error_estimate = false;
      // what a convolution keeps of its Green's functions is none of the input's concern
      if (own.is_convolution())
        own.method = "modal recursion";
      own.memory = 0;
      const ModalConvolution motion(own, parameters.contact_solver, poles, road, road_laws(parameters));
    }

    /// The modes of a body that is no wheel are numbered.
    void check_numbered_mode(const Parameters &parameters)
    {
      const std::string &wanted = parameters.transient.perturbed_mode, number_begin = ":mode ";
      const std::size_t begin = wanted.find(number_begin);
      const auto modes = parameters.modes.find(wanted.substr(0, begin));
      if (begin == std::string::npos || modes == parameters.modes.end() || modes->second.count == 0 ||
          !parameters.transient.is_reduced())
        return;
      // a pair is not split
      const unsigned int most = modes->second.count + 1,
                         number = std::strtoul(wanted.c_str() + begin + number_begin.size(), nullptr, 10);
      if (number <= most)
        return;
      std::vector<std::string> labels;
      for (unsigned int k = 1; k <= modes->second.count; ++k)
        labels.push_back(modes->first + number_begin + std::to_string(k));
      perturbed_mode(parameters.transient, labels);
    }

    /// Points alone, without motion.
    SurfaceShapes surface_of(MeshedBody &body)
    {
      if (body.parameters.is_revolved())
        return body.reduction.surface_points();
      return surface_shapes(body.parameters.is_solid() ? make_surface_trace(body.elastic_body())
                                                       : body.reduction.system().surface,
                            Modes());
    }

    void check_probes(const Parameters &parameters, const MeshedBodies &bodies)
    {
      // a rim is where it is
      const std::vector<ProbeRequest> requests = parse_probes(parameters.signals.probes);
      for (const auto &body : bodies)
        for (const ProbeRequest &request : requests)
          if (body && request.body == body->parameters.name)
            place_probe(request, surface_of(*body), 0);
    }

    void check_sweep_meshes(const MeshedBodies &bodies, const SweepCases &sweep)
    {
      std::set<std::string> seen = {""};
      for (const auto &body : bodies)
        seen.insert(body ? body->reduction.request().key : "");
      for (const SweepCase &one : sweep.cases)
        for (unsigned int k = 0; k < one.keys.size(); ++k)
        {
          if (one.parameters().scene.bodies[k].is_periodic_rail() || !seen.insert(one.keys[k]).second)
            continue;
          const auto body = meshed_body(one.parameters(), one.keys[k], k);
          if (!body->parameters.is_solid())
            continue;
          try
          {
            body->check_contact();
          }
          catch (const InputError &error)
          {
            throw InputError(sweep.section + ", " + case_text(sweep, one) + ": " + error.what());
          }
        }
    }
  } // namespace

  void check_transient_files(const Parameters &parameters, const MeshedBodies &bodies)
  {
    if (!parameters.scene.runs("transient"))
      return;
    const TransientParameters &transient = parameters.transient;
    const LoadOverTime load = load_over_time(transient);
    check_load_over_time(transient, load.name);
    transient_hub(parameters.hub(), load);
    const BodyParameters &body_1 = parameters.scene.bodies[0];
    if (load.hub_displacement && body_1.is_known_by_poles())
      throw InputError(load.name + " moves the hub over time, but body 1, " + body_1.name +
                       ", is known at its contact points alone, by poles, which do not say what the hub's "
                       "acceleration does to it: give a roughness or a Normal force.");
    if (load.hub_displacement && body_1.vibrates())
      check_hub_does_not_jump(transient);
    check_drive(transient, rolling_cases(parameters.rolling, parameters.contacts).front(),
                parameters.placed_contacts());
    if (!transient.is_reduced())
      return; // its modes are others
    for (const auto &body : bodies)
      if (body && body->parameters.name == transient.perturbed_body() &&
          !body->parameters.has_complex_modes() && body->reduction.is_cached(false, true))
      {
        std::vector<std::string> labels;
        for (const std::string &label : body->reduction.modal().labels)
          labels.push_back(body->parameters.name + ":" + label);
        perturbed_mode(transient, labels);
      }
  }

  void check_before_run(const Parameters &parameters, const MeshedBodies &bodies,
                        const std::optional<MeasuredData> &measured)
  {
    const Scene &scene = parameters.scene;
    if (scene.runs("modes") || scene.runs("frequency response") || parameters.needs_modes())
      check_rim(parameters);
    if (scene.runs("transient"))
      check_numbered_mode(parameters);
    if (parameters.goes_through_loading())
      check_load_history(parameters);
    check_data(parameters, measured);
    if (scene.runs("modal convolution"))
      check_modal_convolution(parameters, bodies, measured);
  }

  void check_places(const Parameters &parameters, const MeshedBodies &bodies,
                    const std::vector<SweepCases> &sweeps)
  {
    const Scene &scene = parameters.scene;
    if (scene.runs("frequency response"))
      check_response_points(parameters, bodies);
    if (scene.runs("periodic"))
      check_forced_points(parameters, bodies);
    if (parameters.goes_through_time())
      check_probes(parameters, bodies);
    for (const SweepCases &sweep : sweeps)
      check_sweep_meshes(bodies, sweep);
  }
} // namespace vibrocontact
