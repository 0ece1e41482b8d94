#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/marching/drive.h>

#include <cmath>
#include <complex>
#include <string>

namespace vibrocontact
{
  /// A mass whose normal and lateral mode couple by friction (flutter): it slides over the ground, its amplitude is bounded by
  /// sticking.
  struct Flutter
  {
    static constexpr double friction = 0.4, slip = 0.1, speed = 0.01;
    static constexpr unsigned int n_points = 5, middle = 2, lateral = 2 * n_points + middle;

    /// 1 kg on springs, K = [a c; c b] in normal and lateral direction, and 5e-8 m/N between it and the ground.
    static ContactPair pair(const double damping)
    {
      const double a = 4e7, b = 6e7, c = 2e5;
      ContactPair pair;
      ContactGrid &grid = pair.interface.contacts.only();
      // one point touches, the others are the free columns around it
      grid.n_x = n_points;
      grid.n_y = 1;
      grid.spacing_x = grid.spacing_y = 1e-3;
      pair.interface.gap.assign(n_points, 1.);
      pair.interface.gap[middle] = 0;
      pair.trace.reinit(3 * n_points, 2);
      pair.participation.reinit(2, 3);
      const double angle = 0.5 * std::atan2(2 * c, a - b), cosine = std::cos(angle), sine = std::sin(angle);
      const double lambda[2] = {a * cosine * cosine + 2 * c * sine * cosine + b * sine * sine,
                                a * sine * sine - 2 * c * sine * cosine + b * cosine * cosine};
      for (unsigned int k = 0; k < 2; ++k)
      {
        pair.omega.push_back(std::sqrt(lambda[k]));
        pair.damping_ratio.push_back(damping);
        pair.labels.push_back("mass:" + std::to_string(k));
        pair.body.push_back(1);
        pair.modal_load.push_back(0);
        pair.trace(middle, k) = k == 0 ? cosine : -sine;
        pair.trace(lateral, k) = k == 0 ? sine : cosine;
      }
      pair.residual.reinit(3 * n_points, 3 * n_points);
      for (unsigned int i = 0; i < 3 * n_points; ++i)
        pair.residual(i, i) = 5e-8;
      return pair;
    }

    /// The same motion by poles. @param flows the material flows through the points in its own way, and a further mode stays one
    static void move_by_poles(ContactPair &pair, const bool flows = false)
    {
      static_cast<BodyInContact &>(pair) = by_poles(pair);
      pair.body.clear();
      pair.body_of_pole.assign(pair.n_poles(), 1);
      if (!flows)
        return;
      pair.gradient.reinit(3 * n_points, pair.n_poles());
      pair.residual_gradient.reinit(3 * n_points, 3 * n_points);
      for (unsigned int i = n_points; i < 3 * n_points; ++i)
      {
        for (unsigned int k = 0; k < pair.n_poles(); ++k)
          pair.gradient(i, k) = std::complex<double>(300. * (k + 1), 40. * i);
        pair.residual_gradient(i, i) = 2e-5;
      }
      pair.omega = {9000};
      pair.damping_ratio = {2e-3};
      pair.modal_load = {0};
      pair.body = {1};
      pair.trace.reinit(3 * n_points, 1);
      pair.trace(middle, 0) = 0.3;
      pair.trace(lateral, 0) = -0.2;
      pair.participation.reinit(1, 3);
      pair.labels.insert(pair.labels.begin(), "mass:further");
    }

    static Drive drive(double)
    {
      Drive d;
      d.creepage.speed = speed;
      d.creepage.lateral = slip / speed;
      d.approach = 2e-4;
      return d;
    }
  };
} // namespace vibrocontact
