# Tables and fields of shipped cases and of a solid body on one and two ranks open in pandas, numpy and meshio.
program=$1 mpirun=$2 parameter_files=$3
here=$(dirname "$0")
for name in half_space_rolling carter bouncing_bar oscillator_on_sine oscillator_on_belt tyre_three_points; do
  "$program" "$parameter_files/examples/$name.prm" --quiet --set Output/Figures=false --output "$name"
done
"$program" "$parameter_files/examples/sliding_layer.prm" --quiet --set Output/Figures=false --set Analyses=stability \
  --output sliding_layer
cat >block.prm <<'END_OF_FILE'
set Bodies = block
set Analyses = modes
subsection block
  set Type = block
  subsection Modes
    set Count = 3
  end
end
END_OF_FILE
"$program" block.prm --quiet --set Output/Figures=false --output one_rank
rm -r cache
"$mpirun" -n 2 "$program" block.prm --quiet --set Output/Figures=false --output two_ranks
python3 "$here/readable_results.py" half_space_rolling carter bouncing_bar oscillator_on_sine oscillator_on_belt \
  tyre_three_points sliding_layer one_rank=two_ranks
