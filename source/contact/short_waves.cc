#include <vibrocontact/contact/short_waves.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace vibrocontact
{
  namespace
  {
    constexpr double pi = dealii::numbers::PI;
    using Influence = std::array<std::array<double, 3>, 3>;

    /// Between two cells: kernels 1/r, x^2/r^3, y^2/r^3, xy/r^3, x/r^2, y/r^2, means over both.
    using Kernels = std::array<double, 6>;
    enum
    {
      inverse,
      xx,
      yy,
      xy,
      x_alone,
      y_alone
    };

    /// Of all wave numbers: the closed form under one cell, averaged over the other.
    Influence whole(const HalfSpacePair &pair, const double x, const double y, const double dx,
                    const double dy)
    {
      static const dealii::QGauss<1> gauss(16);
      Influence result{};
      for (unsigned int p = 0; p < gauss.size(); ++p)
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const Influence at =
              pair.influence(x + (gauss.point(p)[0] - 0.5) * dx, y + (gauss.point(q)[0] - 0.5) * dy, dx, dy);
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              result[i][j] += gauss.weight(p) * gauss.weight(q) * at[i][j];
        }
      return result;
    }

    /// Places and weights along y between two cells a lag apart, the mean over both: the triangle of the cells' overlap,
    /// in pieces that end at 0, where kernels have logarithms.
    std::vector<std::pair<double, double>> overlap(const int lag, const double dy)
    {
      static const dealii::QGauss<1> gauss(16);
      std::vector<std::pair<double, double>> result;
      for (const int piece : {lag - 1, lag})
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          // dense at the end nearer to 0
          const double s = gauss.point(q)[0], near = s * s,
                       from = piece >= 0 ? piece + near : piece + 1 - near;
          result.emplace_back(dy * from, gauss.weight(q) * 2 * s * (1 - std::abs(from - lag)));
        }
      return result;
    }

    double sinc(const double x)
    {
      return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x;
    }

    /// The same between all cells that are the same lags apart.
    void add_between_cells(const ContactGrid &grid, const int lag_x, const int lag_y, const Influence &value,
                           DenseMatrix &result)
    {
      const unsigned int n = grid.n_points();
      for (int q = std::max(0, lag_y); q < int(grid.n_y) + std::min(0, lag_y); ++q)
        for (int p = std::max(0, lag_x); p < int(grid.n_x) + std::min(0, lag_x); ++p)
        {
          const unsigned int there = grid.index(p, q), source = grid.index(p - lag_x, q - lag_y);
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              result(contact_row(n, i, there), contact_row(n, j, source)) += value[i][j];
        }
    }

    /// Transforms along x of C_1 times G R s, over z = s |y| >= 0 and without the factor i: zz, xx, yy, zx, zy, xy.
    class CurvatureTransforms
    {
    public:
      explicit CurvatureTransforms(const double nu)
          : nu(nu), b(0.5 + 3 * nu - 2 * nu * nu), d(-0.5 + 3.5 * nu - 2 * nu * nu)
      {
      }

      Kernels operator()(const double z) const
      {
        // of 1 / k^2, s^2 / k^4, s^4 / k^6
        const double decay = std::exp(-z), F_1 = decay / 2, F_2 = (1 + z) * decay / 4,
                     F_3 = (3 + 3 * z + z * z) * decay / 16;
        const double K_0 = std::cyl_bessel_k(0., z), K_1 = std::cyl_bessel_k(1., z), K_2 = K_0 + 2 * K_1 / z,
                     third = z * d / 3;
        return {{(1 - 2 * nu) * ((1 - nu) * F_1 - (1.5 - nu) * F_2),
                 1.5 * F_1 + (-2.5 - 2 * nu + 2 * nu * nu) * F_2 + b * F_3,
                 0.5 * std::pow(1 - 2 * nu, 2) * F_1 + (5 * nu - 4 * nu * nu) * F_2 - b * F_3,
                 z / pi * ((-0.5 - 2.5 * nu + 2 * nu * nu) * K_1 + third * K_2),
                 z / pi * ((0.5 - 2.5 * nu + 2 * nu * nu) * K_0 + third * K_1),
                 -z * decay * ((-1 - 2 * nu + 2 * nu * nu) / 4 + b * (1 + z) / 16)}};
      }

    private:
      const double nu, b, d;
    };
  } // namespace

  DenseMatrix short_wave_compliance(const ContactGrid &grid, const HalfSpacePair &pair, const double K)
  {
    const dealii::QGauss<1> gauss(32);
    const double dx = grid.spacing_x, dy = grid.spacing_y;
    const auto [a, b, c] = pair.constants();
    const unsigned int n = grid.n_points();
    DenseMatrix result(3 * n, 3 * n);
    for (int lag_y = 1 - int(grid.n_y); lag_y < int(grid.n_y); ++lag_y)
    {
      // transforms along x at the wave numbers, k = K s^2
      std::vector<Kernels> transforms(gauss.size(), Kernels{});
      for (unsigned int m = 0; m < gauss.size() && K > 0; ++m)
        for (const auto &[y, weight] : overlap(lag_y, dy))
        {
          const double k = K * std::pow(gauss.point(m)[0], 2), ky = std::abs(k * y),
                       K_0 = std::cyl_bessel_k(0., ky), K_1 = std::cyl_bessel_k(1., ky),
                       sign = y > 0 ? 1 : -1;
          Kernels &here = transforms[m];
          here[inverse] += weight * 2 * K_0;
          here[yy] += weight * 2 * ky * K_1;
          here[xx] += weight * 2 * (K_0 - ky * K_1);
          here[xy] += weight * 2 * k * y * K_0;
          here[x_alone] += weight * pi * std::exp(-ky);
          here[y_alone] += weight * pi * sign * std::exp(-ky);
        }
      for (int lag_x = 1 - int(grid.n_x); lag_x < int(grid.n_x); ++lag_x)
      {
        const double x = lag_x * dx;
        Kernels low{};
        for (unsigned int m = 0; m < gauss.size() && K > 0; ++m)
        {
          const double s = gauss.point(m)[0], k = K * s * s, shape = sinc(k * dx / 2),
                       factor = gauss.weight(m) * 2 * K * s * shape * shape / pi;
          for (const auto kernel : {inverse, xx, yy, y_alone})
            low[kernel] += factor * std::cos(k * x) * transforms[m][kernel];
          for (const auto kernel : {xy, x_alone})
            low[kernel] += factor * std::sin(k * x) * transforms[m][kernel];
        }
        Influence value = whole(pair, x, lag_y * dy, dx, dy);
        const Influence long_waves = {{{{a * low[inverse], c * low[x_alone], c * low[y_alone]}},
                                       {{-c * low[x_alone], a * low[inverse] + b * low[xx], b * low[xy]}},
                                       {{-c * low[y_alone], b * low[xy], a * low[inverse] + b * low[yy]}}}};
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            value[i][j] -= long_waves[i][j];
        add_between_cells(grid, lag_x, lag_y, value, result);
      }
    }
    return result;
  }

  DenseMatrix short_wave_curvature(const ContactGrid &grid, const HalfSpaceMaterial &material,
                                   const double radius, const double K)
  {
    const dealii::QGauss<1> gauss(8);
    const double dx = grid.spacing_x, dy = grid.spacing_y;
    // one turn of the furthest cell per panel; means over a cell leave 1e-4 of the shortest waves
    const double panel = 2 * pi / (grid.n_x * dx), shortest = 32 * pi / dx;
    const unsigned int n_panels = std::ceil((shortest - K) / panel);
    std::vector<double> waves, factors;
    for (unsigned int p = 0; p < n_panels; ++p)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double s = K + (p + gauss.point(q)[0]) * panel;
        waves.push_back(s);
        factors.push_back(gauss.weight(q) * panel * std::pow(sinc(s * dx / 2), 2) /
                          (pi * s * radius * material.shear_modulus()));
      }
    const CurvatureTransforms transforms(material.poisson_ratio);
    DenseMatrix result(3 * grid.n_points(), 3 * grid.n_points());
    for (int lag_y = 1 - int(grid.n_y); lag_y < int(grid.n_y); ++lag_y)
    {
      std::vector<Kernels> means(waves.size(), Kernels{});
      const auto places = overlap(lag_y, dy);
      for (unsigned int m = 0; m < waves.size(); ++m)
        for (const auto &[y, weight] : places)
          // beyond it nothing is left
          if (const double z = waves[m] * std::abs(y); z < 40)
          {
            const Kernels here = transforms(z);
            for (unsigned int k = 0; k < here.size(); ++k)
              means[m][k] += factors[m] * weight * (k < 4 || y > 0 ? here[k] : -here[k]);
          }
      for (int lag_x = 1 - int(grid.n_x); lag_x < int(grid.n_x); ++lag_x)
      {
        Kernels sum{};
        for (unsigned int m = 0; m < waves.size(); ++m)
        {
          const double cosine = std::cos(waves[m] * lag_x * dx), sine = std::sin(waves[m] * lag_x * dx);
          for (const unsigned int k : {0, 1, 2, 4})
            sum[k] += cosine * means[m][k];
          for (const unsigned int k : {3, 5})
            sum[k] += sine * means[m][k];
        }
        const auto [zz, along_x, along_y, zx, zy, between] = sum;
        add_between_cells(grid, lag_x, lag_y,
                          {{{{zz, zx, zy}}, {{-zx, along_x, between}}, {{-zy, between, along_y}}}}, result);
      }
    }
    return result;
  }
} // namespace vibrocontact
