#include "readers.h"

#include <vibrocontact/base/parameter_file.h>
#include <vibrocontact/scene/road.h>

#include <cmath>

using namespace vibrocontact;

void readers::road(const std::string &bytes)
{
  const std::size_t end = std::min(bytes.find("\n\n"), bytes.size());
  file_of("table.csv", bytes.substr(std::min(end + 2, bytes.size())));
  taken(
      [&]
      {
        const ParameterFile file("road.prm", bytes.substr(0, end));
        RoadParameters parameters;
        dealii::ParameterHandler prm;
        prm.enter_subsection("Road");
        parameters.declare_parameters(prm);
        prm.leave_subsection();
        file.parse(prm);
        // no other file, however it is called
        for (std::string *const table : {&parameters.table, &parameters.speed_table})
          if (!table->empty())
            *table = "table.csv";
        parameters.check();
        const double end_time = 0.01;
        const Road road(parameters, {-1e-3, 0, 2e-3}, {0, 1e-6, 1e-6}, end_time);
        for (unsigned int k = 0; k <= 10; ++k)
          for (unsigned int point = 0; point < road.n_points(); ++point)
          {
            const double t = k * end_time / 10;
            road.at(point, t);
            road.before(point, t);
            road.after(point, t);
            road.next_jump(t);
            road.next_step_up(point, t);
            if (!std::isfinite(road.height(point, t)))
              throw std::logic_error("a height of the road is no number");
          }
      });
}
