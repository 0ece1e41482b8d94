#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/fe/make_elastic_body.h>
#include <vibrocontact/fe/revolved_section.h>
#include <vibrocontact/reduction/damped_wheel.h>
#include <vibrocontact/reduction/revolved_point.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// how far a damper may be from the nearest point of the section, as a share of its largest radius
    constexpr double farthest_place = 0.03;

    /// What multiplies W, U or V of a mode at an angle.
    double around(const RevolvedShapes &section, const unsigned int mode, const unsigned int component,
                  const double theta)
    {
      const unsigned int n = section.waves[mode];
      return wave_weight(n, n == 0 ? component == 2 : section.odd[mode], theta, component);
    }

    void add_absorbers(const RevolvedShapes &section, const WheelDamper &damper, const unsigned int point,
                       std::vector<AttachedMass> &all)
    {
      const double a = section.points[2 * point] - section.hub[0], r = section.points[2 * point + 1];
      for (unsigned int k = 0; k < damper.number; ++k)
      {
        const double theta = angle_of(damper, k);
        // along x, y, z: axial, radial, circumferential
        const std::array<double, 3> axes[3] = {
            {{0, 1, 0}}, {{std::sin(theta), 0, -std::cos(theta)}}, {{std::cos(theta), 0, std::sin(theta)}}};
        for (unsigned int c = 0; c < 3; ++c)
        {
          AttachedMass one{sprung_mass(damper, c), damper.name + " " + std::to_string(k + 1), {}};
          const std::array<double, 3> arm = {{r * std::sin(theta), a, -r * std::cos(theta)}};
          for (unsigned int d = 0; d < 3; ++d)
          {
            const unsigned int e = (d + 1) % 3, f = (d + 2) % 3;
            one.along[d] = axes[c][d];
            one.along[3 + d] = arm[e] * axes[c][f] - arm[f] * axes[c][e];
          }
          for (unsigned int mode = 0; mode < section.n_modes(); ++mode)
            one.motion.push_back(section.value(point, c, mode) * around(section, mode, c, theta));
          all.push_back(std::move(one));
        }
      }
    }

    void add_ring(const RevolvedShapes &section, const WheelDamper &damper, const unsigned int point,
                  std::vector<AttachedMass> &all)
    {
      const double a = section.points[2 * point] - section.hub[0], r = section.points[2 * point + 1];
      const int highest =
          section.waves.empty() ? -1 : *std::max_element(section.waves.begin(), section.waves.end());
      for (int n = 0; n <= highest; ++n)
        for (int odd = 0; odd < (n == 0 ? 1 : 2); ++odd)
          for (unsigned int c = 0; c < 3; ++c)
          {
            AttachedMass one{
                sprung_mass(damper, c), damper.name + " n=" + std::to_string(n) + (odd ? "#2" : ""), {}};
            if (n > 0)
              one.mass /= 2;
            if (n == 0 && c == 0)
              one.along[1] = 1;
            if (n == 0 && c == 2)
              one.along[4] = -r;
            // means of a unit motion times the shape, over the mean square of the latter
            if (n == 1 && c == 0)
              one.along[odd ? 5 : 3] = r;
            if (n == 1 && c > 0)
            {
              one.along[odd ? 0 : 2] = odd || c == 2 ? 1 : -1;
              one.along[odd ? 5 : 3] = !odd && c == 2 ? a : -a;
            }
            for (unsigned int mode = 0; mode < section.n_modes(); ++mode)
            {
              const bool own = section.waves[mode] == n && section.odd[mode] == odd;
              const double sign = c == 2 && (n == 0 || odd) ? -1 : 1;
              one.motion.push_back(own ? sign * section.value(point, c, mode) : 0.);
            }
            all.push_back(std::move(one));
          }
    }
  } // namespace

  SprungMass sprung_mass(const WheelDamper &damper, const unsigned int direction)
  {
    constexpr const char *directions[3] = {"axial", "radial", "circumferential"};
    if (damper.direction != directions[direction])
      return {damper.mass, 0, 0};
    return {damper.mass, 2 * dealii::numbers::PI * damper.frequency, damper.loss_factor};
  }

  double angle_of(const WheelDamper &damper, const unsigned int number)
  {
    return dealii::numbers::PI * (damper.first_angle / 180 + 2. * number / damper.number);
  }

  RevolvedShapes shapes_without_modes(const RevolvedSection &section)
  {
    RevolvedShapes result;
    for (const auto &point : section.boundary(0).points)
      result.points.insert(result.points.end(), {point[0], point[1]});
    for (const RevolvedSection::Part &part : section.parts())
      result.cells.insert(result.cells.end(), {part.centre[0], part.centre[1], double(part.material)});
    return result;
  }

  unsigned int point_of(const RevolvedShapes &section, const WheelDamper &damper, const std::string &path)
  {
    unsigned int nearest = 0;
    double distance = 1e300, largest = 0;
    for (unsigned int i = 0; i < section.n_points(); ++i)
    {
      const double a = section.points[2 * i], r = section.points[2 * i + 1],
                   here = std::hypot(a - damper.axial, r - damper.radius);
      largest = std::max(largest, r);
      if (here < distance)
      {
        distance = here;
        nearest = i;
      }
    }
    if (distance > farthest_place * largest)
      throw InputError(path + "/" + damper.name + " has its place at axial position " +
                       number_text(damper.axial) + " m, radius " + number_text(damper.radius) +
                       " m, which is not on the wheel: the nearest point of its section is at " +
                       number_text(section.points[2 * nearest]) + " m, " +
                       number_text(section.points[2 * nearest + 1]) + " m.");
    return nearest;
  }

  std::vector<AttachedMass> attached_masses(const RevolvedShapes &section,
                                            const std::vector<WheelDamper> &dampers, const std::string &path)
  {
    std::vector<AttachedMass> all;
    for (const WheelDamper &damper : dampers)
    {
      if (damper.is_layer())
        continue;
      const unsigned int point = point_of(section, damper, path);
      if (damper.is_ring())
        add_ring(section, damper, point, all);
      else
        add_absorbers(section, damper, point, all);
    }
    return all;
  }

  DenseMatrix loss_of_parts(const RevolvedShapes &section, const std::vector<double> &loss_factor)
  {
    const unsigned int n = section.n_modes(), n_cells = section.n_cells();
    DenseMatrix result(n, n);
    for (std::size_t pair = 0; pair < section.first.size(); ++pair)
    {
      double sum = 0;
      for (unsigned int cell = 0; cell < n_cells; ++cell)
        sum += loss_factor[cell] * section.energies[pair * n_cells + cell];
      result(section.first[pair], section.second[pair]) = result(section.second[pair], section.first[pair]) =
          sum;
    }
    return result;
  }

  std::vector<double> loss_of_materials(const RevolvedShapes &section, const BodyParameters &body)
  {
    const ElasticModel<3> model = elastic_model(body);
    std::vector<double> result;
    for (unsigned int cell = 0; cell < section.n_cells(); ++cell)
      result.push_back(model.material_of(section.cells[3 * cell + 2]).loss_factor);
    return result;
  }

  std::vector<double> loss_of_layers(const RevolvedShapes &section, const std::vector<WheelDamper> &dampers,
                                     const std::string &path)
  {
    std::vector<double> result(section.n_cells(), 0.);
    for (const WheelDamper &damper : dampers)
    {
      if (!damper.is_layer())
        continue;
      double lowest = 1e300, highest = 0;
      bool any = false;
      for (unsigned int cell = 0; cell < section.n_cells(); ++cell)
      {
        const double r = section.cells[3 * cell + 1];
        lowest = std::min(lowest, r);
        highest = std::max(highest, r);
        if (r > damper.inner_radius && r < damper.outer_radius)
        {
          result[cell] += damper.loss_factor;
          any = true;
        }
      }
      if (!any)
        throw InputError(path + "/" + damper.name +
                         " is a layer without any element: the centres of the wheel's lie at radii from " +
                         number_text(lowest) + " to " + number_text(highest) + " m; give other radii.");
    }
    return result;
  }
} // namespace vibrocontact
