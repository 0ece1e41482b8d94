#include <vibrocontact/contact/contact_operator.h>

#include <fftw3.h>

#include <algorithm>
#include <complex>
#include <numeric>

namespace vibrocontact
{
  /// Cyclic convolution with the nine kernels on a grid padded to at least twice the size.
  struct HalfSpaceOperator::FourierProduct
  {
    using Spectrum = std::vector<std::complex<double>>;

    /// @param points_x, points_y size of the rectangle of sources and targets
    FourierProduct(const HalfSpaceOperator &op, const unsigned int points_x, const unsigned int points_y)
        : points_x(points_x), points_y(points_y), n_x(fast_size(2 * points_x - 1)),
          n_y(fast_size(2 * points_y - 1)), n_k(n_x / 2 + 1), real(fftw_alloc_real(std::size_t(n_x) * n_y)),
          complex(reinterpret_cast<std::complex<double> *>(fftw_alloc_complex(std::size_t(n_k) * n_y))),
          forward(
              fftw_plan_dft_r2c_2d(n_y, n_x, real, reinterpret_cast<fftw_complex *>(complex), FFTW_ESTIMATE)),
          backward(
              fftw_plan_dft_c2r_2d(n_y, n_x, reinterpret_cast<fftw_complex *>(complex), real, FFTW_ESTIMATE))
    {
      const int last_x = points_x - 1, last_y = points_y - 1;
      const double scale = 1. / (double(n_x) * n_y);
      for (unsigned int k = 0; k < 9; ++k)
      {
        std::fill(real, real + std::size_t(n_x) * n_y, 0.);
        for (int dy = -last_y; dy <= last_y; ++dy)
          for (int dx = -last_x; dx <= last_x; ++dx)
            real[((dy + n_y) % n_y) * n_x + (dx + n_x) % n_x] = scale * op.kernel(k / 3, k % 3, dx, dy);
        fftw_execute(forward);
        kernel[k].assign(complex, complex + std::size_t(n_k) * n_y);
      }
    }

    ~FourierProduct()
    {
      fftw_destroy_plan(forward);
      fftw_destroy_plan(backward);
      fftw_free(real);
      fftw_free(complex);
    }

    /// @param first_x, first_y grid indices of the rectangle's first point
    void vmult(const ContactGrid &grid, const unsigned int first_x, const unsigned int first_y,
               DenseVector &y, const DenseVector &R)
    {
      const unsigned int n = grid.n_points(), first = grid.index(first_x, first_y);
      const std::size_t n_spectrum = std::size_t(n_k) * n_y;
      for (unsigned int c = 0; c < 3; ++c)
      {
        std::fill(real, real + std::size_t(n_x) * n_y, 0.);
        for (unsigned int j = 0; j < points_y; ++j)
          std::copy_n(R.begin() + c * n + first + j * grid.n_x, points_x, real + std::size_t(j) * n_x);
        fftw_execute(forward);
        force[c].assign(complex, complex + n_spectrum);
      }
      for (unsigned int c = 0; c < 3; ++c)
      {
        for (std::size_t k = 0; k < n_spectrum; ++k)
          complex[k] = kernel[3 * c][k] * force[0][k] + kernel[3 * c + 1][k] * force[1][k] +
                       kernel[3 * c + 2][k] * force[2][k];
        fftw_execute(backward);
        for (unsigned int j = 0; j < points_y; ++j)
          std::copy_n(real + std::size_t(j) * n_x, points_x, y.begin() + c * n + first + j * grid.n_x);
      }
    }

    const unsigned int points_x, points_y;

  private:
    /// smallest even product of 2, 3, 5 that is not below n
    static int fast_size(const int n)
    {
      for (int size = n + n % 2;; size += 2)
      {
        int rest = size;
        for (const int factor : {2, 3, 5})
          while (rest % factor == 0)
            rest /= factor;
        if (rest == 1)
          return size;
      }
    }

    const int n_x, n_y, n_k;
    double *const real;
    std::complex<double> *const complex;
    const fftw_plan forward, backward;
    Spectrum kernel[9], force[3];
  };

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
      whole = std::make_unique<FourierProduct>(*this, grid.n_x, grid.n_y);
    whole->vmult(grid, 0, 0, y, R);
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
    if (!part || part->points_x != high_x - low_x + 1 || part->points_y != high_y - low_y + 1)
      part = std::make_unique<FourierProduct>(*this, high_x - low_x + 1, high_y - low_y + 1);
    if (y.size() != R.size())
      y.reinit(R.size());
    part->vmult(grid, low_x, low_y, y, R);
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
          const double *const values = kernels[3 * row + column].data() - shift;
          double *const to = &block(row * m, column * m + j);
          for (unsigned int i = 0; i < m; ++i)
            to[i] = values[at[i]];
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
