#include <vibrocontact/contact/contact_operator.h>
#include <vibrocontact/contact/fourier_product.h>

#include <algorithm>
#include <numeric>

namespace vibrocontact
{
  namespace
  {
    /// one influence matrix per offset; first_x may lie upstream of the grid's own offsets
    std::vector<std::array<std::array<double, 3>, 3>>
    influences(const ContactGrid &grid, const HalfSpacePair &pair, const unsigned int reach)
    {
      const int n_x = grid.n_x, n_y = grid.n_y;
      std::vector<std::array<std::array<double, 3>, 3>> table;
      table.reserve((2 * n_x - 1 + reach) * (2 * n_y - 1));
      for (int dy = 1 - n_y; dy < n_y; ++dy)
        for (int dx = 1 - n_x - int(reach); dx < n_x; ++dx)
          table.push_back(
              pair.influence(dx * grid.spacing_x, dy * grid.spacing_y, grid.spacing_x, grid.spacing_y));
      return table;
    }

    /// below this many multiplications a direct sum beats the transforms
    constexpr std::size_t direct_below = 400000;
  } // namespace

  HalfSpaceOperator::HalfSpaceOperator(const ContactGrid &grid, const HalfSpacePair &pair,
                                       const std::vector<double> &upstream)
      : grid(grid), width(2 * grid.n_x - 1)
  {
    const unsigned int height = 2 * grid.n_y - 1, reach = upstream.size() - 1;
    const auto table = influences(grid, pair, reach);
    for (unsigned int k = 0; k < 9; ++k)
      kernels[k].resize(std::size_t(width) * height);
    for (unsigned int j = 0; j < height; ++j)
      for (unsigned int i = 0; i < width; ++i)
      {
        const auto *const here = &table[std::size_t(j) * (width + reach) + i + reach];
        const std::size_t at = std::size_t(j) * width + i;
        for (unsigned int column = 0; column < 3; ++column)
        {
          kernels[column][at] = (*here)[0][column];
          for (unsigned int row = 1; row < 3; ++row)
          {
            double sum = 0;
            for (unsigned int k = 0; k <= reach; ++k)
              sum += upstream[k] * (*(here - k))[row][column];
            kernels[3 * row + column][at] = sum;
          }
        }
      }
  }

  HalfSpaceOperator::~HalfSpaceOperator() = default;

  void HalfSpaceOperator::vmult(DenseVector &y, const DenseVector &R,
                                const std::vector<unsigned int> &sources) const
  {
    const unsigned int n = n_points();
    y.reinit(3 * n, true);
    if (std::size_t(9) * n * sources.size() < direct_below)
      return vmult_direct(y, R, sources);
    if (!whole)
      whole = fourier_product(grid.n_x, grid.n_y);
    whole->vmult(y.data(), R.data(), grid.n_x, n);
  }

  std::unique_ptr<FourierProduct> HalfSpaceOperator::fourier_product(const unsigned int points_x,
                                                                     const unsigned int points_y) const
  {
    const FourierProduct::Size size = {points_x, points_y};
    return std::make_unique<FourierProduct>(
        [this](const unsigned int row, const unsigned int column, const int offset_x, const int offset_y)
        { return kernel(row, column, offset_x, offset_y); },
        3, size, size);
  }

  void HalfSpaceOperator::vmult_among(DenseVector &y, const DenseVector &R,
                                      const std::vector<unsigned int> &sources) const
  {
    if (sources.empty())
      return;
    unsigned int low_x = grid.n_x, high_x = 0, low_y = grid.n_y, high_y = 0;
    for (const unsigned int point : sources)
    {
      low_x = std::min(low_x, point % grid.n_x);
      high_x = std::max(high_x, point % grid.n_x);
      low_y = std::min(low_y, point / grid.n_x);
      high_y = std::max(high_y, point / grid.n_x);
    }
    const unsigned int points_x = high_x - low_x + 1, points_y = high_y - low_y + 1,
                       first = grid.index(low_x, low_y);
    if (!part || part->sources.x != points_x || part->sources.y != points_y)
      part = fourier_product(points_x, points_y);
    if (y.size() != R.size())
      y.reinit(R.size());
    part->vmult(y.data() + first, R.data() + first, grid.n_x, n_points());
  }

  void HalfSpaceOperator::vmult_direct(DenseVector &y, const DenseVector &R,
                                       const std::vector<unsigned int> &sources) const
  {
    const unsigned int n = n_points();
    y = 0;
    for (const unsigned int source : sources)
    {
      const unsigned int i = source % grid.n_x, j = source / grid.n_x;
      const double force[3] = {R[source], R[n + source], R[2 * n + source]};
      for (unsigned int row = 0; row < 3; ++row)
        for (unsigned int jt = 0; jt < grid.n_y; ++jt)
        {
          const std::size_t first = std::size_t(jt + grid.n_y - 1 - j) * width + grid.n_x - 1 - i;
          const double *const k0 = &kernels[3 * row][first], *const k1 = &kernels[3 * row + 1][first],
                              *const k2 = &kernels[3 * row + 2][first];
          double *const out = y.data() + row * n + jt * grid.n_x;
          for (unsigned int it = 0; it < grid.n_x; ++it)
            out[it] += k0[it] * force[0] + k1[it] * force[1] + k2[it] * force[2];
        }
    }
  }

  void HalfSpaceOperator::extract(const std::vector<unsigned int> &points, DenseMatrix &block) const
  {
    const unsigned int m = points.size();
    block.reinit(3 * m);
    std::vector<std::size_t> at(m);
    for (unsigned int i = 0; i < m; ++i)
      at[i] = std::size_t(points[i] / grid.n_x + grid.n_y - 1) * width + points[i] % grid.n_x + grid.n_x - 1;
    for (unsigned int column = 0; column < 3; ++column)
      for (unsigned int j = 0; j < m; ++j)
      {
        const std::size_t shift = std::size_t(points[j] / grid.n_x) * width + points[j] % grid.n_x;
        for (unsigned int row = 0; row < 3; ++row)
        {
          const std::vector<double> &values = kernels[3 * row + column];
          double *const to = &block(row * m, column * m + j);
          for (unsigned int i = 0; i < m; ++i)
            to[i] = values[at[i] - shift];
        }
      }
  }

  DenseMatrix HalfSpaceOperator::matrix() const
  {
    std::vector<unsigned int> all(n_points());
    std::iota(all.begin(), all.end(), 0u);
    DenseMatrix result;
    extract(all, result);
    return result;
  }

  double HalfSpaceOperator::mean_diagonal(const unsigned int component) const
  {
    return kernel(component, component, 0, 0);
  }

  DenseMatrix half_space_compliance(const ContactGrid &grid, const HalfSpacePair &pair)
  {
    return HalfSpaceOperator(grid, pair, {1.}).matrix();
  }
} // namespace vibrocontact
