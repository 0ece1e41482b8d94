#include <vibrocontact/base/number_text.h>
#include <vibrocontact/reduction/damped_wheel.h>
#include <vibrocontact/reduction/revolved_reduction.h>
#include <vibrocontact/reduction/wave_mode.h>

#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// angles of the surface's points for each wave of the shortest mode; least number of them
    constexpr unsigned int angles_per_wave = 8, fewest_angles = 64;
  } // namespace

  ModalReduction RevolvedReduction::modes(const ModeParameters &parameters, const WheelFrame &frame,
                                          SurfaceShapes &shapes, RevolvedShapes &on_section,
                                          FlowReduction *const flow) const
  {
    dealii::Timer timer;
    const std::vector<WaveMode> modes = all_modes(parameters, frame, flow != nullptr);
    ModalReduction result;
    result.n_dofs = section->n_dofs();
    std::vector<WheelLabel> labels;
    std::vector<std::vector<double>> traces;
    std::vector<const std::vector<double> *> participations;
    for (const WaveMode &mode : modes)
      for (const bool odd : {false, true})
      {
        if (odd && mode.n == 0)
          continue;
        result.omega.push_back(mode.omega);
        labels.push_back({mode.family, mode.nodal_circles, mode.n});
        result.load.push_back(mode.load[odd]);
        participations.push_back(odd ? &mode.odd : &mode.even);
        result.orthonormality_error = std::max(result.orthonormality_error, mode.orthonormality_error);
        result.residual = std::max(result.residual, mode.residual);
        if (!contact)
          continue;
        const DenseMatrix spread = around(mode.n, odd);
        DenseVector at_points(spread.m());
        spread.vmult(at_points, DenseVector(mode.tread.begin(), mode.tread.end()));
        traces.emplace_back(at_points.begin(), at_points.end());
      }
    const unsigned int n_modes = result.omega.size();
    result.participation.reinit(n_modes, 6);
    for (unsigned int k = 0; k < n_modes; ++k)
      for (unsigned int d = 0; d < 6; ++d)
        result.participation(k, d) = (*participations[k])[d];
    result.trace.reinit(contact ? 3 * contact->grid.n_points() : 0, n_modes);
    for (unsigned int k = 0; k < traces.size(); ++k)
      std::copy(traces[k].begin(), traces[k].end(), &result.trace(0, k));
    result.labels = unique_texts(labels);
    result.damping_ratio = wheel_damping(labels, parameters);
    shapes = surface_shapes(modes);
    on_section = revolved_shapes(modes);
    if (flow)
      *flow = flow_of(modes);
    result.seconds = timer.wall_time();
    run_log().line(std::to_string(n_modes) + " modes by harmonics: " + time_text(result.seconds) +
                   "; orthonormality error " + number_text(result.orthonormality_error) + ", residual " +
                   number_text(result.residual));
    return result;
  }

  FlowReduction RevolvedReduction::flow_of(const std::vector<WaveMode> &modes) const
  {
    FlowReduction flow;
    std::vector<unsigned int> first;
    for (const WaveMode &mode : modes)
    {
      first.push_back(flow.omega.size());
      const unsigned int copies = mode.n == 0 ? 1 : 2;
      flow.omega.resize(first.back() + copies, mode.omega);
      flow.names.resize(first.back() + copies, WheelLabel{mode.family, mode.nodal_circles, mode.n}.text());
    }
    for (auto *const matrix : {&flow.fixed, &flow.turning, &flow.of_square})
      matrix->reinit(flow.omega.size(), flow.omega.size());
    for (unsigned int a = 0; a < modes.size(); ++a)
      for (unsigned int b = 0; b < modes.size(); ++b)
      {
        const unsigned int n = modes[a].n, k = first[a], l = first[b];
        if (modes[b].n != n)
          continue;
        const double coupling = modes[a].coriolis[modes[b].number],
                     square = modes[a].of_square[modes[b].number];
        flow.of_square(k, l) = square;
        if (n == 0)
        {
          flow.fixed(k, l) = coupling;
          continue;
        }
        flow.of_square(k + 1, l + 1) = square;
        flow.fixed(k, l + 1) = coupling;
        flow.fixed(l + 1, k) = -coupling;
        if (a == b)
        {
          flow.turning(k, k + 1) = n;
          flow.turning(k + 1, k) = -double(n);
        }
      }
    return flow;
  }

  RevolvedShapes RevolvedReduction::revolved_shapes(const std::vector<WaveMode> &modes) const
  {
    RevolvedShapes result = shapes_without_modes(*section);
    using Rigid = RevolvedSection::RigidMotion;
    const auto across = section->rigid_motion(Rigid::across_axle), tilt = section->rigid_motion(Rigid::tilt),
               about = section->rigid_motion(Rigid::about_axle);
    result.hub = {section->hub_place(),
                  section->hub_place() - lateral_position,
                  radius,
                  section->inertia(1, across, across),
                  -section->inertia(1, across, tilt),
                  section->inertia(0, about, about),
                  section->inertia(1, tilt, tilt)};
    std::vector<const WaveMode *> each;
    for (const WaveMode &mode : modes)
      for (int odd = 0; odd < (mode.n == 0 ? 1 : 2); ++odd)
      {
        each.push_back(&mode);
        result.omega.push_back(mode.omega);
        result.waves.push_back(mode.n);
        result.odd.push_back(odd);
        result.shapes.insert(result.shapes.end(), mode.boundary.begin(), mode.boundary.end());
      }
    const unsigned int n_parts = result.n_cells();
    for (unsigned int l = 0; l < each.size(); ++l)
      for (unsigned int k = 0; k <= l; ++k)
      {
        if (result.waves[k] != result.waves[l] || result.odd[k] != result.odd[l])
          continue;
        result.first.push_back(k);
        result.second.push_back(l);
        const std::size_t n_of_n = each[k]->energies.size() / n_parts;
        for (unsigned int part = 0; part < n_parts; ++part)
          result.energies.push_back(each[k]->energies[part * n_of_n + each[l]->number]);
      }
    return result;
  }

  SurfaceShapes RevolvedReduction::surface() const
  {
    return surface_shapes({});
  }

  SurfaceShapes RevolvedReduction::surface_shapes(const std::vector<WaveMode> &modes) const
  {
    unsigned int n_angles = fewest_angles;
    for (const WaveMode &mode : modes)
      n_angles = std::max(n_angles, angles_per_wave * mode.n);
    const RevolvedSection::Boundary boundary = section->boundary(0);
    const unsigned int n_around = boundary.points.size();
    SurfaceShapes result;
    const auto angle = [&](const unsigned int k) { return 2 * dealii::numbers::PI * k / n_angles; };
    for (unsigned int k = 0; k < n_angles; ++k)
    {
      for (const auto &point : boundary.points)
        result.points.insert(result.points.end(), {point[1] * std::sin(angle(k)), point[0] - lateral_position,
                                                   radius - point[1] * std::cos(angle(k))});
      const int here = k * n_around, next = (k + 1) % n_angles * n_around;
      for (const auto &edge : boundary.edges)
        result.quads.insert(result.quads.end(), {here + int(edge[0]), here + int(edge[1]),
                                                 next + int(edge[1]), next + int(edge[0])});
    }
    for (const WaveMode &mode : modes)
      for (const bool odd : {false, true})
      {
        if (odd && mode.n == 0)
          continue;
        result.omega.push_back(mode.omega);
        for (unsigned int k = 0; k < n_angles; ++k)
        {
          const double theta = angle(k), c = std::cos(mode.n * theta), s = std::sin(mode.n * theta);
          // n = 0: both families in one
          const double across = odd ? s : c, along = mode.n == 0 ? -1. : odd ? -c : s;
          for (unsigned int i = 0; i < n_around; ++i)
          {
            const double u_a = across * mode.boundary[3 * i], u_r = across * mode.boundary[3 * i + 1],
                         u_t = along * mode.boundary[3 * i + 2];
            result.shapes.push_back(float(u_r * std::sin(theta) + u_t * std::cos(theta)));
            result.shapes.push_back(float(u_a));
            result.shapes.push_back(float(-u_r * std::cos(theta) + u_t * std::sin(theta)));
          }
        }
      }
    return result;
  }
} // namespace vibrocontact
