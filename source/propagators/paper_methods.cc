#include <vibrocontact/contact/laws/signorini.h>
#include <vibrocontact/propagators/paper_methods.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  PaperMethod::PaperMethod(const Form form, const BodyInContact &model, const std::vector<Complex> &state,
                           const double time_step)
      : form(form), h(time_step), motion(model, state, time_step), poles(model.poles)
  {
    for (unsigned int k = 0; k < model.n_poles(); ++k)
      gains.push_back(2. * model.right(0, k) * model.left(0, k));
  }

  void PaperMethod::run(const unsigned long n_steps, const double *heights, const double *rates,
                        double *displacements, double *forces)
  {
    if (form == Form::growing)
      run_growing(n_steps, heights, displacements, forces);
    else
      run_gauss(n_steps, heights, rates, displacements, forces);
  }

  void PaperMethod::run_growing(const unsigned long n_steps, const double *heights, double *displacements,
                                double *forces)
  {
    const unsigned int n = poles.size();
    std::vector<double> alpha(n, 0.), beta(n, 0.);
    double first = 0;
    for (unsigned int k = 0; k < n; ++k)
      first += h * (gains[k] * std::exp(poles[k] * h)).real();
    for (unsigned long step = 0; step < n_steps; ++step)
    {
      const double end = (step + 1) * h, begin = step * h;
      double u = 0;
      motion.add_to(&u);
      motion.advance();
      for (unsigned int k = 0; k < n; ++k)
      {
        const double decay = std::exp(poles[k].real() * end), c = std::cos(poles[k].imag() * end),
                     s = std::sin(poles[k].imag() * end);
        // Re gain e^(lambda t) (alpha - j beta)
        const double real = c * alpha[k] + s * beta[k], imaginary = s * alpha[k] - c * beta[k];
        u += decay * (gains[k].real() * real - gains[k].imag() * imaginary);
      }
      const double force = rigid_force((heights[step] - u) / first);
      for (unsigned int k = 0; k < n; ++k)
      {
        const double growth = std::exp(-poles[k].real() * begin) * force * h;
        alpha[k] += growth * std::cos(poles[k].imag() * begin);
        beta[k] += growth * std::sin(poles[k].imag() * begin);
      }
      forces[step] = force;
      displacements[step] = u + first * force;
    }
  }

  void PaperMethod::run_gauss(const unsigned long n_steps, const double *heights, const double *rates,
                              double *displacements, double *forces)
  {
    const unsigned int n = poles.size();
    const double places[2] = {(1 - 1 / std::sqrt(3.)) * h / 2, (1 + 1 / std::sqrt(3.)) * h / 2};
    // weights of the states and of displacement and velocity at the end
    std::vector<Complex> weight[2], factor(n);
    double psi[2][2] = {{0, 0}, {0, 0}};
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int k = 0; k < n; ++k)
      {
        weight[i].push_back(h / 2 * std::exp(poles[k] * (h - places[i])));
        psi[0][i] += (gains[k] * weight[i][k]).real();
        psi[1][i] += (gains[k] * poles[k] * weight[i][k]).real();
        factor[k] = std::exp(poles[k] * h);
      }
    const double printed = form == Form::gauss_as_printed ? 2 : 1;
    const double determinant = psi[0][0] * psi[1][1] - psi[0][1] * psi[1][0];
    std::vector<Complex> z(n, 0.);
    for (unsigned long step = 0; step < n_steps; ++step)
    {
      double u = 0, v = 0;
      motion.add_to(&u);
      motion.add_rate_to(&v);
      motion.advance();
      for (unsigned int k = 0; k < n; ++k)
      {
        z[k] = {z[k].real() * factor[k].real() - z[k].imag() * factor[k].imag(),
                z[k].real() * factor[k].imag() + z[k].imag() * factor[k].real()};
        const Complex cz = gains[k] * z[k];
        u += cz.real();
        v += poles[k].real() * cz.real() - poles[k].imag() * cz.imag();
      }
      double q1 = 0, q2 = 0;
      if (heights[step] >= u)
      {
        const double du = (heights[step] - u) / printed, dv = (rates[step] - v) / printed;
        q1 = (psi[1][1] * du - psi[0][1] * dv) / determinant;
        q2 = (psi[0][0] * dv - psi[1][0] * du) / determinant;
        if (form == Form::gauss && q1 + q2 < 0)
          q1 = q2 = 0;
        for (unsigned int k = 0; k < n; ++k)
          z[k] += weight[0][k] * q1 + weight[1][k] * q2;
      }
      displacements[step] = u + psi[0][0] * q1 + psi[0][1] * q2;
      forces[step] = 0.5 * (q1 + q2);
    }
  }
} // namespace vibrocontact
