#include <vibrocontact/base/log.h>
#include <vibrocontact/run/probes_on_bodies.h>

#include <algorithm>
#include <optional>
#include <sstream>

namespace vibrocontact
{
  std::vector<Probe> transient_probes(const Parameters &parameters, const MeshedBodies &bodies,
                                      const std::vector<SurfaceShapes> &unreduced)
  {
    std::vector<Probe> probes;
    const std::vector<ProbeRequest> requests = parse_probes(parameters.signals.probes);
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      if (!bodies[b])
        continue;
      MeshedBody &body = *bodies[b];
      if (body.parameters.has_complex_modes())
      {
        if (body.reduction.request().wheel && !requests.empty())
          run_log().line("no probes on " + body.parameters.name +
                         ": what rolls is known by poles at its contact points");
        continue;
      }
      std::optional<SurfaceShapes> own_shapes;
      const auto surface = [&]() -> const SurfaceShapes &
      {
        if (unreduced.empty() && !own_shapes)
          own_shapes = shapes_of_modes(body, parameters.scene.bodies[b]);
        return unreduced.empty() ? *own_shapes : unreduced[b];
      };
      std::vector<ProbeRequest> own;
      for (const ProbeRequest &request : requests)
        if (request.name.empty() && body.reduction.request().wheel)
          for (const ProbeRequest &rim :
               rim_probes(body.parameters.name, surface(), body.reduction.request().wheel->axle_height,
                          body.reduction.request().wheel->rim_radius))
            own.push_back(rim);
        else if (request.body == body.parameters.name)
          own.push_back(request);
      for (const ProbeRequest &request : own)
      {
        probes.push_back(place_probe(request, surface(), 0));
        std::ostringstream text;
        text << "probe " << probes.back().name << ": " << request.body << " at " << probes.back().place
             << " m along " << request.direction;
        run_log().line(text.str());
      }
    }
    return probes;
  }

  void place_in_pair(const Parameters &parameters, const ContactPair &pair, std::vector<Probe> &probes)
  {
    const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
    for (Probe &probe : probes)
      for (unsigned int b = 0; b < bodies.size(); ++b)
        if (bodies[b].name == probe.body)
          probe.first = std::find(pair.body.begin(), pair.body.end(), b + 1) - pair.body.begin();
  }

  void request_probe_shapes(const Parameters &parameters, const MeshedBodies &bodies)
  {
    for (const ProbeRequest &request : parse_probes(parameters.signals.probes))
      for (const auto &body : bodies)
        if (body && !body->parameters.has_complex_modes() &&
            (request.body == body->parameters.name ||
             (request.name.empty() && body->reduction.request().wheel)))
          body->reduction.surface_shapes();
  }
} // namespace vibrocontact
