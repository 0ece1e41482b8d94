# A run that finds its modes in the cache writes the same shapes as the run that computed them.
program=$1
cat >case.prm <<'END'
set Bodies = block
set Analyses = modes
subsection block
  set Type = block
  subsection Modes
    set Count = 3
  end
end
END
"$program" case.prm --set Output/Figures=false --output first
"$program" case.prm --set Output/Figures=false --output second
grep -q "modes found in the cache" second/log.txt || { echo "FAILED: nothing was cached"; exit 1; }
[ -f first/fields/mode_block_0000.vtu ] || { echo "FAILED: no shapes"; exit 1; }
diff -r first/fields second/fields
diff first/mode_block.pvd second/mode_block.pvd
