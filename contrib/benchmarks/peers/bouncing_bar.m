% bouncing_bar.m ELEMENTS STEP THETA: the bar of parameter_files/examples/bouncing_bar.prm, 10 m, thrown against a rigid stop.
% Linear elements, theta method, reaction of the end of the step, no penetration. Writes bar.csv: impulse, energy at the end,
% microseconds per step.
elements = str2double(argv(){1}); h = str2double(argv(){2}); theta = str2double(argv(){3});
n = elements + 1; dx = 10 / elements; E = 900; rho = 1;
one = ones(n, 1); ends = 2 * one; ends([1 n]) = 1;
M = spdiags([one, 2 * ends, one] * rho * dx / 6, -1:1, n, n);
K = spdiags([-one, ends, -one] * E / dx, -1:1, n, n);
q = 5 * one; v = -10 * one; impulse = 0;
A = chol(M + h^2 * theta^2 * K);
unit = zeros(n, 1); unit(1) = 1; response = A \ (A' \ unit);
begin = cputime; steps = round(1.5 / h);
for k = 1:steps
  v1 = A \ (A' \ (M * v - h * K * (q + h * theta * (1 - theta) * v)));
  gap = q(1) + h * (theta * v1(1) + (1 - theta) * v(1));
  if gap < 0
    R = -gap / (h^2 * theta * response(1));
    v1 += h * R * response; impulse += h * R;
  end
  q += h * (theta * v1 + (1 - theta) * v); v = v1;
end
f = fopen("bar.csv", "w");
fprintf(f, "%.17g, %.17g, %.17g\n", impulse, 0.5 * (v' * M * v + q' * K * q), 1e6 * (cputime - begin) / steps);
fclose(f);
