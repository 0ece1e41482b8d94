#include <vibrocontact/analyses/modal_convolution/method_comparison.h>
#include <vibrocontact/analyses/modal_convolution/run_method_comparison.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/table.h>
#include <vibrocontact/numerics/wide_loops.h>
#include <vibrocontact/run/road_body.h>

#include <cmath>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    std::vector<ComparedMethod> compare_body(const Parameters &parameters, const MeshedBodies &bodies,
                                             const std::optional<MeasuredData> &measured,
                                             const unsigned int number)
    {
      const ComparisonParameters &comparison = parameters.comparison;
      const std::string &name = parameters.scene.bodies[number].name;
      ModalConvolutionParameters own = parameters.modal_convolution;
      const auto compare = [&](const std::string &rows, const RoadParameters &road)
      {
        if (rows.empty())
          return std::vector<ComparedMethod>();
        const RoadBody body =
            road_body(parameters, bodies, measured, number, {own.friction, road.speed, own.time_step});
        const BodyInContact poles = by_poles(body.body);
        return compare_methods(read_comparison_rows(rows, name), comparison.repetitions, own, poles,
                               number == 0 ? road_of(parameters, body) : road, body.places, body.shapes);
      };
      if (number == 0)
        return compare(comparison.rows, parameters.road);
      const auto further = comparison.further_bodies.find(name);
      if (further == comparison.further_bodies.end())
        return {};
      own.force_shape = further->second.force_shape;
      return compare(further->second.rows, further->second.road);
    }
  } // namespace

  nlohmann::ordered_json run_method_comparison(const Parameters &parameters, const MeshedBodies &bodies,
                                               const std::optional<MeasuredData> &measured,
                                               const std::string &folder)
  {
    run_log().block("Comparison of methods");
    run_log().value("registers", wide_loops_name());
    Table table(
        {"body", "method", "step_s", "steps", "memory_steps", "error_displacement_m", "error_force_N",
         "error_impulse", "seconds_per_step"},
        {"Errors against the exact motion (displacement: largest; force: rms away from events; "
         "impulse: worst point, relative to the largest) and cost; a method that broke down has no line",
         "steps may be coarse on purpose: rows are exempt from what ends a run with exit code 2"});
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (unsigned int number = 0; number < parameters.scene.bodies.size(); ++number)
      for (const ComparedMethod &method : compare_body(parameters, bodies, measured, number))
      {
        const std::string &body = parameters.scene.bodies[number].name;
        nlohmann::ordered_json entry = {{"body", body},
                                        {"method", method.method},
                                        {"step_s", method.time_step},
                                        {"steps", method.n_steps},
                                        {"memory_steps", method.memory},
                                        {"exempt", true}};
        std::ostringstream text;
        text << body << ", " << method.method << ", h = " << method.time_step * 1e3 << " ms, memory "
             << method.memory << ": ";
        if (std::isfinite(method.error_displacement) && std::isfinite(method.error_force) &&
            std::isfinite(method.error_impulse))
        {
          entry["error_displacement_m"] = method.error_displacement;
          entry["error_force_N"] = method.error_force;
          entry["error_impulse"] = method.error_impulse;
          table.add_row({body, method.method, method.time_step, double(method.n_steps), double(method.memory),
                         method.error_displacement, method.error_force, method.error_impulse,
                         method.seconds_per_step});
          text << method.error_displacement << " m, " << method.error_force << " N, ";
        }
        else
        {
          entry["broke_down"] = true;
          text << "no finite numbers, ";
        }
        entry["seconds_per_step"] = method.seconds_per_step;
        text << method.seconds_per_step * 1e9 << " ns per step";
        run_log().line(text.str());
        json.push_back(entry);
      }
    on_first_rank([&] { table.write(folder + "/method_comparison.csv"); });
    return json;
  }
} // namespace vibrocontact
