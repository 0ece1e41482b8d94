# --check leaves nothing behind, also where an entry names a file to write.
program=$1
cat >case.prm <<'END'
set Bodies = wheel
set Analyses = modes
subsection wheel
  set Type = wheel
  subsection Modes
    set Count = 2
  end
  subsection Wheel
    set Write mesh = wheel.msh
  end
end
END
"$program" case.prm --check
[ "$(ls)" = case.prm ] || { echo "FAILED: left behind: $(ls)"; exit 1; }
