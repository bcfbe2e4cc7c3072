// Depth alone (PASS_DEPTH) or the pick id (PASS_ID).
flat in uint v_pick;
#ifdef PASS_ID
out uint o_id;
#endif

void main() {
#ifdef PASS_ID
  o_id = v_pick;
#endif
}
