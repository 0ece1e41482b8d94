#include <vibrocontact/waveguide/plane_section.h>
#include <vibrocontact/waveguide/track_span.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace vibrocontact
{
  using namespace dealii;
  using Complex = std::complex<double>;

  TrackSection track_section(const SectionElements &elements, const SectionShapes &shapes)
  {
    TrackSection result;
    result.matrices = reduced_section(elements, shapes);
    const auto [from, to] = elements.extent(section_boundary::foot);
    result.foot_width = to - from;
    for (unsigned int d = 0; d < 3; ++d)
    {
      SparseMatrix<double> springs(elements.pattern);
      elements.boundary_springs(section_boundary::foot, d, springs);
      result.foot_springs[d] = reduced_matrix(springs, shapes);
      result.foot_loads[d] = shapes.reduced(elements.boundary_load(section_boundary::foot, from, to, d));
    }
    result.foot_lever =
        shapes.reduced(elements.boundary_load(section_boundary::foot, from, to, 2, 1, (from + to) / 2));
    return result;
  }

  TrackSection with_slab(const TrackSection &rail, const TrackSlab &slab)
  {
    const unsigned int m = rail.matrices.n_shapes(), w = m, t = m + 1;
    const auto grow = [&](DenseMatrix &matrix)
    {
      DenseMatrix larger(m + 2, m + 2);
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int j = 0; j < m; ++j)
          larger(i, j) = matrix(i, j);
      matrix = larger;
    };
    TrackSection result = rail;
    SectionMatrices &matrices = result.matrices;
    for (auto *set : {&matrices.stiffness, &matrices.loss_stiffness, &result.foot_springs})
      for (DenseMatrix &matrix : *set)
        grow(matrix);
    grow(matrices.mass);
    for (DenseVector *load :
         {&result.foot_loads[0], &result.foot_loads[1], &result.foot_loads[2], &result.foot_lever})
      *load = with_slab_at_rest(*load);
    matrices.axial.insert(matrices.axial.end(), {false, true});
    // kappa G A (w' - t)^2 + E I t'^2, and the bed
    for (const bool loss : {false, true})
    {
      auto &K = loss ? matrices.loss_stiffness : matrices.stiffness;
      const double factor = loss ? slab.loss_factor : 1, shear = factor * slab.shear_stiffness;
      K[0](w, w) = (loss ? slab.bed_loss : 1) * slab.bed_stiffness;
      K[0](t, t) = shear;
      K[1](t, w) = -shear;
      K[2](w, w) = shear;
      K[2](t, t) = factor * slab.bending_stiffness;
    }
    matrices.mass(w, w) = slab.mass;
    matrices.mass(t, t) = slab.mass * slab.gyration_radius * slab.gyration_radius;
    // pads between foot and slab
    DenseMatrix &springs = result.foot_springs[2];
    for (unsigned int i = 0; i < m; ++i)
      springs(i, w) = springs(w, i) = -rail.foot_loads[2](i);
    springs(w, w) = rail.foot_width;
    return result;
  }

  DenseVector with_slab_at_rest(const DenseVector &load)
  {
    DenseVector result(load.size() + 2);
    for (unsigned int i = 0; i < load.size(); ++i)
      result(i) = load(i);
    return result;
  }

  namespace
  {
    /// Stiffness of a pad against motions of the seat: x, y, z [N/m], roll [N m].
    std::vector<Complex> pad_against_seat(const TrackSupport &support, const double factor,
                                          const double foot_width)
    {
      std::vector<Complex> result;
      for (const double stiffness : support.pad_stiffness)
        result.push_back(factor * stiffness * Complex(1, support.pad_loss));
      result.push_back(result[2] * foot_width * foot_width / 12.);
      return result;
    }

    /// The pad's slice has forces between seat and foot as its last loads, the seat held: it moves by r = A f under the forces
    /// f = K (d - r) of the pad, d the foot's mean motions, and the pad then pushes the foot with c = K r:
    ///
    ///   c = G d,   G = K (1 + A K)^-1 A K,   (1 - G C) c = G F^T q.
    Slice on_sleeper(const Slice &pad, const std::vector<Complex> &K, const ComplexMatrix &A)
    {
      const unsigned int n_seat = A.m(), n = pad.n_loads() - n_seat, n_ends = pad.stiffness.m();
      ComplexMatrix one_AK(n_seat, n_seat), G(n_seat, n_seat), one_GC(n_seat, n_seat), c(n_seat, n_ends + n),
          d(n_seat, n_ends + n);
      for (unsigned int i = 0; i < n_seat; ++i)
        for (unsigned int j = 0; j < n_seat; ++j)
        {
          one_AK(i, j) = A(i, j) * K[j] + (i == j ? 1. : 0.);
          G(i, j) = A(i, j) * K[j];
        }
      one_AK.compute_lu_factorization();
      one_AK.solve(G);
      for (unsigned int i = 0; i < n_seat; ++i)
        for (unsigned int j = 0; j < n_seat; ++j)
          G(i, j) *= K[i];
      for (unsigned int i = 0; i < n_seat; ++i)
        for (unsigned int j = 0; j < n_seat; ++j)
        {
          one_GC(i, j) = i == j ? 1. : 0.;
          for (unsigned int k = 0; k < n_seat; ++k)
            one_GC(i, j) -= G(i, k) * pad.compliance(n + k, n + j);
        }
      for (unsigned int k = 0; k < n_seat; ++k)
      {
        for (unsigned int i = 0; i < n_ends; ++i)
          d(k, i) = pad.forces(i, n + k);
        for (unsigned int j = 0; j < n; ++j)
          d(k, n_ends + j) = pad.compliance(n + k, j);
      }
      G.mmult(c, d);
      one_GC.compute_lu_factorization();
      one_GC.solve(c);
      Slice result;
      result.stiffness = pad.stiffness;
      result.forces.reinit(n_ends, n);
      result.compliance.reinit(n, n);
      const auto product = [&](const unsigned int a, const unsigned int b)
      {
        Complex sum = 0;
        for (unsigned int k = 0; k < n_seat; ++k)
          sum += d(k, a) * c(k, b);
        return sum;
      };
      for (unsigned int i = 0; i < n_ends; ++i)
      {
        for (unsigned int j = 0; j < n_ends; ++j)
          result.stiffness(i, j) -= product(i, j);
        for (unsigned int j = 0; j < n; ++j)
          result.forces(i, j) = pad.forces(i, j) + product(i, n_ends + j);
      }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          result.compliance(i, j) = pad.compliance(i, j) + product(n_ends + i, n_ends + j);
      return result;
    }

    /// Pieces without loads of one section at a frequency; equally long ones are made once.
    class UniformPieces
    {
    public:
      UniformPieces(SectionAtFrequency section, const SpanElements &elements)
          : section(std::move(section)), elements(elements)
      {
      }

      const Slice &of_length(const double length)
      {
        auto made =
            std::find_if(known.begin(), known.end(),
                         [&](const auto &one) { return std::abs(one.first - length) < 1e-9 * length; });
        if (made == known.end())
          made =
              known.insert(made, {length, uniform_slice(section, length, elements.length, elements.degree)});
        return made->second;
      }

      const SectionAtFrequency section;

    private:
      const SpanElements elements;
      /// by their lengths [m]
      std::vector<std::pair<double, Slice>> known;
    };
  } // namespace

  SpanPieces span_pieces(const TrackSection &section, const TrackSupport &support,
                         const unsigned int n_seat_motions, const TrackSpan &span,
                         const SpanElements &elements, const Complex omega,
                         const std::vector<AxialLoad> &loads)
  {
    const unsigned int m = section.matrices.n_shapes();
    const double begin = span.begin, end = span.end, pad_begin = span.support - support.pad_length / 2,
                 pad_end = span.support + support.pad_length / 2, slack = 1e-9 * (end - begin);
    const std::vector<Complex> pad_stiffness = pad_against_seat(support, span.pad_factor, section.foot_width);
    ComplexMatrix springs(m, m);
    for (unsigned int d = 0; d < 3; ++d)
    {
      const Complex per_area = pad_stiffness[d] / (section.foot_width * support.pad_length);
      for (unsigned int c = 0; c < m; ++c)
        for (unsigned int r = 0; r < m; ++r)
          springs(r, c) += per_area * section.foot_springs[d](r, c);
    }
    UniformPieces between({section.matrices, omega}, elements),
        on_pad({section.matrices, omega, springs}, elements);

    std::vector<double> divisions = {begin, pad_begin, pad_end, end};
    for (const AxialLoad &load : loads)
      for (const double place : {load.centre - load.length / 2, load.centre + load.length / 2})
        if (place > begin + slack && place < end + slack)
          divisions.push_back(place);
    std::sort(divisions.begin(), divisions.end());
    divisions.erase(std::unique(divisions.begin(), divisions.end(),
                                [&](const double a, const double b) { return std::abs(a - b) < slack; }),
                    divisions.end());

    /// pieces between two places; `with` may hold the sleeper's forces beside the loads
    const auto pieces =
        [&](const double from, const double to, UniformPieces &unloaded, const std::vector<AxialLoad> &with)
    {
      const SectionAtFrequency &at = unloaded.section;
      std::optional<Slice> whole;
      for (unsigned int k = 0; k + 1 < divisions.size(); ++k)
      {
        const double a = divisions[k], b = divisions[k + 1];
        if (a < from - slack || b > to + slack)
          continue;
        bool loaded = false, evenly = true;
        for (const AxialLoad &load : with)
          if (load.length > 0 && std::abs((a + b) / 2 - load.centre) < load.length / 2)
          {
            loaded = true;
            evenly = evenly && load.linear.all_zero();
          }
        std::optional<Slice> piece;
        if (loaded && evenly)
        {
          // under even loads equal elements double as well
          unsigned int n = 1;
          while (n * elements.length < (b - a) * (1 - 1e-9))
            n *= 2;
          piece = element_slice(at, a, (b - a) / n, elements.degree, with);
          for (; n > 1; n /= 2)
            piece = join(*piece, *piece);
        }
        else if (loaded)
        {
          const unsigned int n = std::ceil((b - a) / elements.length - 1e-9);
          for (unsigned int e = 0; e < n; ++e)
            follow(piece, element_slice(at, a + e * (b - a) / n, (b - a) / n, elements.degree, with));
        }
        else
          piece = with_loads(unloaded.of_length(b - a), with.size());
        for (unsigned int j = 0; j < with.size(); ++j)
          if (with[j].length == 0 && std::abs(with[j].centre - b) < slack)
            add_section_load(*piece, j, with[j].constant);
        follow(whole, *piece);
      }
      return *whole;
    };

    std::vector<AxialLoad> with_seat = loads;
    for (unsigned int d = 0; d < n_seat_motions; ++d)
    {
      AxialLoad load;
      load.centre = span.support;
      load.length = support.pad_length;
      load.constant = d < 3 ? section.foot_loads[d] : section.foot_lever;
      load.constant /= (d < 3 ? section.foot_width : std::pow(section.foot_width, 3) / 12) * load.length;
      load.linear.reinit(m);
      with_seat.push_back(load);
    }
    SpanPieces result;
    result.pad_stiffness = pad_stiffness;
    result.on_pad = pieces(pad_begin, pad_end, on_pad, with_seat);
    if (pad_begin > begin + slack)
      result.before = pieces(begin, pad_begin, between, loads);
    if (pad_end < end - slack)
      result.behind = pieces(pad_end, end, between, loads);
    return result;
  }

  Slice on_seat(const SpanPieces &pieces, const ComplexMatrix &seat)
  {
    Slice whole = seat.m() > 0 ? on_sleeper(pieces.on_pad, pieces.pad_stiffness, seat) : pieces.on_pad;
    if (pieces.before)
      whole = join(*pieces.before, whole);
    if (pieces.behind)
      whole = join(whole, *pieces.behind);
    return whole;
  }

  Slice span_slice(const TrackSection &section, const TrackSupport &support, const ComplexMatrix &seat,
                   const TrackSpan &span, const SpanElements &elements, const Complex omega,
                   const std::vector<AxialLoad> &loads)
  {
    return on_seat(span_pieces(section, support, seat.m(), span, elements, omega, loads), seat);
  }
} // namespace vibrocontact
