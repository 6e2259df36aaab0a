(** What the bounds of the edge functions have to cover: roundings, and corners that are off.

    See "The bound, and what it proves" in docs/speed.md. How far what is computed may be from the
    determinants of the same corners, and how far these may be from those of the exact corners, which
    are off by at most [place] in p and q and by [weight] in w. *)
Require Import ZArith Reals Psatz String.
From Flocq Require Import Core Mult_error.
From Reftrace Require Import Geometry Trees Rounding EdgeBounds.
Open Scope R_scope.

(** ** What rounding does *)

Definition float_vec (v : vec) : Prop := is_float (vx v) /\ is_float (vy v) /\ is_float (vz v).
Definition within (m k : R) (v : vec) : Prop :=
  Rabs (vx v) <= m /\ Rabs (vy v) <= m /\ Rabs (vz v) <= k.
Definition close (place weight : R) (v v' : vec) : Prop :=
  Rabs (vx v - vx v') <= place /\ Rabs (vy v - vy v') <= place /\ Rabs (vz v - vz v') <= weight.
Definition pixel_ray (up right : R) : vec := V right up 1.

Section Rounded.
Local Open Scope string_scope.
Let v3 (v : vec) (k : nat) : R := match k with 0%nat => vx v | 1%nat => vy v | _ => vz v end.
Let env (a b c : vec) (up right : R) : renv := REnv (fun n =>
  if String.eqb n "ap" then vx a else if String.eqb n "aq" then vy a else if String.eqb n "aw" then vz a else
  if String.eqb n "bp" then vx b else if String.eqb n "bq" then vy b else if String.eqb n "bw" then vz b else
  if String.eqb n "cp" then vx c else if String.eqb n "cq" then vy c else if String.eqb n "cw" then vz c else
  if String.eqb n "up" then up else right) (fun _ => true).
Let cx (p q r s : string) := Sub (Mul (Var p) (Var q)) (Mul (Var r) (Var s)).
Let tree_e := Add (Add (cx "ap" "bq" "aq" "bp") (Mul (cx "aw" "bp" "ap" "bw") (Var "up")))
                  (Mul (cx "aq" "bw" "aw" "bq") (Var "right")).
Let tree_T := Add (Add (Mul (Var "ap") (cx "bq" "cw" "bw" "cq")) (Mul (Var "aq") (cx "bw" "cp" "bp" "cw")))
                  (Mul (Var "aw") (cx "bp" "cq" "bq" "cp")).

Lemma A_5 : A 5 <= 1 + 6 * u.
Proof. unfold A. rewrite u_value. simpl. lra. Qed.

Lemma env_floats a b c up right : float_vec a -> float_vec b -> float_vec c -> is_float up ->
  is_float right -> forall n, is_float (r_var (env a b c up right) n).
Proof.
  intros [A1 [A2 A3]] [B1 [B2 B3]] [C1 [C2 C3]] U R n. simpl.
  repeat match goal with |- is_float (if ?x then _ else _) => destruct x; [assumption|] end. assumption.
Qed.

Lemma product_le x y X Y : Rabs x <= X -> Rabs y <= Y -> Rabs x * Rabs y <= X * Y.
Proof. intros. apply Rmult_le_compat; auto using Rabs_pos. Qed.

Lemma edge_rounding a b up right m k r : float_vec a -> float_vec b -> is_float up -> is_float right ->
  within m k a -> within m k b -> Rabs up <= r -> Rabs right <= r ->
  Rabs (edge_at a b up right - det a b (pixel_ray up right))
  <= 6 * u * (4 * r * (m * k) + 2 * (m * m)) + (1 + 6 * u) * (5 + 4 * r) * eta.
Proof.
  intros Fa Fb Fu Fr [Ax [Ay Az]] [Bx [By_ Bz]] U R.
  assert (E := error (env a b a up right) (env_floats a b a up right Fa Fb Fa Fu Fr) tree_e).
  assert (G : ring_expr tree_e) by (simpl; repeat split). specialize (E G). clear G.
  change (fl (env a b a up right) tree_e) with (edge_at a b up right) in E.
  replace (ex (env a b a up right) tree_e) with (det a b (pixel_ray up right)) in E
    by (unfold det, dot, cross; simpl; ring).
  eapply Rle_trans; [exact E|]. clear E.
  change (Rounding.depth tree_e) with 5%nat.
  assert (Um := u_pos). assert (N := eta_pos). assert (K := A_5). assert (K1 := A_ge_1 5).
  set (s1 := Rabs (vx a) * Rabs (vy b) + Rabs (vy a) * Rabs (vx b)).
  set (sy := Rabs (vz a) * Rabs (vx b) + Rabs (vx a) * Rabs (vz b)).
  set (sx := Rabs (vy a) * Rabs (vz b) + Rabs (vz a) * Rabs (vy b)).
  replace (mag (env a b a up right) tree_e) with (s1 + sy * Rabs up + sx * Rabs right)
    by (unfold s1, sy, sx; simpl; ring).
  replace (room (env a b a up right) tree_e)
    with (s1 + sy * Rabs up + sx * Rabs right + (4 + 2 * Rabs up + 2 * Rabs right) * eta)
    by (unfold s1, sy, sx; simpl; ring).
  assert (S1 : s1 <= 2 * (m * m)) by (generalize (product_le _ _ _ _ Ax By_) (product_le _ _ _ _ Ay Bx);
    unfold s1; lra).
  assert (Sy : sy <= 2 * (m * k)) by (generalize (product_le _ _ _ _ Az Bx) (product_le _ _ _ _ Ax Bz);
    unfold sy; lra).
  assert (Sx : sx <= 2 * (m * k)) by (generalize (product_le _ _ _ _ Ay Bz) (product_le _ _ _ _ Az By_);
    unfold sx; lra).
  assert (P : forall x y, 0 <= Rabs x * Rabs y) by (intros; apply Rmult_le_pos; apply Rabs_pos).
  assert (0 <= s1) by (unfold s1; generalize (P (vx a) (vy b)) (P (vy a) (vx b)); lra).
  assert (0 <= sy) by (unfold sy; generalize (P (vz a) (vx b)) (P (vx a) (vz b)); lra).
  assert (0 <= sx) by (unfold sx; generalize (P (vy a) (vz b)) (P (vz a) (vy b)); lra).
  assert (sy * Rabs up <= 2 * (m * k) * r) by (apply Rmult_le_compat; auto using Rabs_pos).
  assert (sx * Rabs right <= 2 * (m * k) * r) by (apply Rmult_le_compat; auto using Rabs_pos).
  assert (0 <= sy * Rabs up) by (apply Rmult_le_pos; auto using Rabs_pos).
  assert (0 <= sx * Rabs right) by (apply Rmult_le_pos; auto using Rabs_pos).
  set (mg := s1 + sy * Rabs up + sx * Rabs right) in *.
  assert (Hmg : mg <= 4 * r * (m * k) + 2 * (m * m)) by (unfold mg; lra).
  assert (Hz : (4 + 2 * Rabs up + 2 * Rabs right) * eta <= (5 + 4 * r) * eta)
    by (apply Rmult_le_compat_r; lra).
  assert (Q : (A 5 - 1) * mg <= 6 * u * (4 * r * (m * k) + 2 * (m * m)))
    by (apply Rmult_le_compat; unfold mg; lra).
  assert (Z : 0 <= (4 + 2 * Rabs up + 2 * Rabs right) * eta)
    by (apply Rmult_le_pos; generalize (Rabs_pos up) (Rabs_pos right); lra).
  assert (Q2 : A 5 * ((4 + 2 * Rabs up + 2 * Rabs right) * eta) <= (1 + 6 * u) * ((5 + 4 * r) * eta))
    by (apply Rmult_le_compat; lra).
  lra.
Qed.

Lemma volume_rounding a b c m k : float_vec a -> float_vec b -> float_vec c ->
  within m k a -> within m k b -> within m k c ->
  Rabs (volume a b c - det a b c)
  <= 36 * (u * (m * m * k)) + (1 + 6 * u) * (3 + 4 * m + 2 * k) * eta.
Proof.
  intros Fa Fb Fc [Ax [Ay Az]] [Bx [By_ Bz]] [Cx [Cy Cz]].
  assert (Z0 : is_float 0) by apply generic_format_0.
  assert (E := error (env a b c 0 0) (env_floats a b c 0 0 Fa Fb Fc Z0 Z0) tree_T).
  assert (G : ring_expr tree_T) by (simpl; repeat split). specialize (E G). clear G.
  change (fl (env a b c 0 0) tree_T) with (volume a b c) in E.
  replace (ex (env a b c 0 0) tree_T) with (det a b c) in E
    by (unfold det, dot, cross; simpl; ring).
  eapply Rle_trans; [exact E|]. clear E.
  change (Rounding.depth tree_T) with 5%nat.
  assert (Um := u_pos). assert (N := eta_pos). assert (K := A_5). assert (K1 := A_ge_1 5).
  set (s1 := Rabs (vx b) * Rabs (vy c) + Rabs (vy b) * Rabs (vx c)).
  set (sy := Rabs (vz b) * Rabs (vx c) + Rabs (vx b) * Rabs (vz c)).
  set (sx := Rabs (vy b) * Rabs (vz c) + Rabs (vz b) * Rabs (vy c)).
  set (mg := Rabs (vx a) * sx + Rabs (vy a) * sy + Rabs (vz a) * s1).
  set (et := (3 + 2 * Rabs (vx a) + 2 * Rabs (vy a) + 2 * Rabs (vz a)) * eta).
  replace (mag (env a b c 0 0) tree_T) with mg by (unfold mg, s1, sy, sx; simpl; ring).
  replace (room (env a b c 0 0) tree_T) with (mg + et) by (unfold mg, et, s1, sy, sx; simpl; ring).
  assert (S1 : s1 <= 2 * (m * m)) by (generalize (product_le _ _ _ _ Bx Cy) (product_le _ _ _ _ By_ Cx);
    unfold s1; lra).
  assert (Sy : sy <= 2 * (m * k)) by (generalize (product_le _ _ _ _ Bz Cx) (product_le _ _ _ _ Bx Cz);
    unfold sy; lra).
  assert (Sx : sx <= 2 * (m * k)) by (generalize (product_le _ _ _ _ By_ Cz) (product_le _ _ _ _ Bz Cy);
    unfold sx; lra).
  assert (P : forall x y, 0 <= Rabs x * Rabs y) by (intros; apply Rmult_le_pos; apply Rabs_pos).
  assert (0 <= s1) by (unfold s1; generalize (P (vx b) (vy c)) (P (vy b) (vx c)); lra).
  assert (0 <= sy) by (unfold sy; generalize (P (vz b) (vx c)) (P (vx b) (vz c)); lra).
  assert (0 <= sx) by (unfold sx; generalize (P (vy b) (vz c)) (P (vz b) (vy c)); lra).
  assert (Rabs (vx a) * sx <= m * (2 * (m * k))) by (apply Rmult_le_compat; auto using Rabs_pos).
  assert (Rabs (vy a) * sy <= m * (2 * (m * k))) by (apply Rmult_le_compat; auto using Rabs_pos).
  assert (Rabs (vz a) * s1 <= k * (2 * (m * m))) by (apply Rmult_le_compat; auto using Rabs_pos).
  assert (M0 : 0 <= mg) by (unfold mg; repeat apply Rplus_le_le_0_compat; apply Rmult_le_pos;
    auto using Rabs_pos).
  assert (Hmg : mg <= 6 * (m * m * k)) by (unfold mg; lra).
  assert (He : et <= (3 + 4 * m + 2 * k) * eta) by (apply Rmult_le_compat_r; lra).
  assert (0 <= et).
  { apply Rmult_le_pos; [|lra]. generalize (Rabs_pos (vx a)) (Rabs_pos (vy a)) (Rabs_pos (vz a)). lra. }
  assert (Q : (A 5 - 1) * mg <= 6 * u * (6 * (m * m * k))) by (apply Rmult_le_compat; lra).
  assert (Q2 : A 5 * et <= (1 + 6 * u) * ((3 + 4 * m + 2 * k) * eta)) by (apply Rmult_le_compat; lra).
  lra.
Qed.
End Rounded.

(** ** What the errors of the corners move *)

Lemma product_off x y x' y' X Y dx dy : Rabs (x - x') <= dx -> Rabs (y - y') <= dy ->
  Rabs x <= X -> Rabs y' <= Y -> Rabs (x * y - x' * y') <= dx * Y + X * dy.
Proof.
  intros Dx Dy Hx Hy. replace (x * y - x' * y') with ((x - x') * y' + x * (y - y')) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult.
  generalize (product_le _ _ _ _ Dx Hy) (product_le _ _ _ _ Hx Dy). lra.
Qed.

Lemma within_close m k place weight v v' : within m k v -> close place weight v v' ->
  within (m + place) (k + weight) v'.
Proof.
  intros [A1 [A2 A3]] [B1 [B2 B3]].
  assert (T : forall x y d e, Rabs x <= d -> Rabs (x - y) <= e -> Rabs y <= d + e).
  { intros x y d e D E. replace y with (x + - (x - y)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  repeat split; eauto.
Qed.

Lemma edge_moved a b a' b' up right m k place weight r : 0 <= place -> 0 <= weight ->
  within m k a -> within m k b -> close place weight a a' -> close place weight b b' ->
  Rabs up <= r -> Rabs right <= r ->
  let f := m + place in let h := k + weight in
  Rabs (det a b (pixel_ray up right) - det a' b' (pixel_ray up right))
  <= 4 * r * (place * h + f * weight) + 4 * (f * place).
Proof.
  intros P0 W0 Ha Hb Ca Cb U R f h.
  destruct (within_close _ _ _ _ _ _ Hb Cb) as [Bx' [By' Bz']]. fold f h in Bx', By', Bz'.
  destruct Ha as [Ax [Ay Az]], Hb as [Bx [By_ Bz]], Ca as [DAx [DAy DAz]], Cb as [DBx [DBy DBz]].
  assert (m <= f) by (unfold f; lra). assert (k <= h) by (unfold h; lra).
  assert (xy := product_off _ _ _ _ f f _ _ DAx DBy ltac:(lra) By').
  assert (yx := product_off _ _ _ _ f f _ _ DAy DBx ltac:(lra) Bx').
  assert (zx := product_off _ _ _ _ h f _ _ DAz DBx ltac:(lra) Bx').
  assert (xz := product_off _ _ _ _ f h _ _ DAx DBz ltac:(lra) Bz').
  assert (yz := product_off _ _ _ _ f h _ _ DAy DBz ltac:(lra) Bz').
  assert (zy := product_off _ _ _ _ h f _ _ DAz DBy ltac:(lra) By').
  set (d1 := vx a * vy b - vx a' * vy b') in *. set (d2 := vy a * vx b - vy a' * vx b') in *.
  set (d3 := vz a * vx b - vz a' * vx b') in *. set (d4 := vx a * vz b - vx a' * vz b') in *.
  set (d5 := vy a * vz b - vy a' * vz b') in *. set (d6 := vz a * vy b - vz a' * vy b') in *.
  replace (det a b (pixel_ray up right) - det a' b' (pixel_ray up right))
    with (d1 - d2 + ((d3 - d4) * up + (d5 - d6) * right))
    by (unfold d1, d2, d3, d4, d5, d6, det, dot, cross, pixel_ray; simpl; ring).
  eapply Rle_trans; [apply Rabs_triang|].
  assert (S : forall x y X, Rabs x <= X -> Rabs y <= X -> Rabs (x - y) <= 2 * X).
  { intros x y X HX HY. unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  assert (E1 := S _ _ (2 * (f * place)) ltac:(eapply Rle_trans; [apply xy | lra]) ltac:(eapply Rle_trans;
    [apply yx | lra])).
  assert (Ey := S _ _ (place * h + f * weight) ltac:(eapply Rle_trans; [apply zx | lra])
    ltac:(eapply Rle_trans; [apply xz | lra])).
  assert (Ex := S _ _ (place * h + f * weight) ltac:(eapply Rle_trans; [apply yz | lra])
    ltac:(eapply Rle_trans; [apply zy | lra])).
  assert (Py := product_le _ _ _ _ Ey U). assert (Px := product_le _ _ _ _ Ex R).
  assert (Rabs ((d3 - d4) * up + (d5 - d6) * right) <= 4 * r * (place * h + f * weight)).
  { eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult. lra. }
  lra.
Qed.

Lemma volume_moved a b c a' b' c' m k place weight : 0 <= place -> 0 <= weight ->
  within m k a -> within m k b -> within m k c ->
  close place weight a a' -> close place weight b b' -> close place weight c c' ->
  let f := m + place in let h := k + weight in
  Rabs (det a b c - det a' b' c') <= 6 * f * (2 * (place * h) + f * weight).
Proof.
  intros P0 W0 Ha Hb Hc Ca Cb Cc f h.
  destruct (within_close _ _ _ _ _ _ Hb Cb) as [Bx' [By' Bz']].
  destruct (within_close _ _ _ _ _ _ Hc Cc) as [Cx' [Cy' Cz']]. fold f h in Bx', By', Bz', Cx', Cy', Cz'.
  destruct Ha as [Ax [Ay Az]], Hb as [Bx [By_ Bz]], Hc as [Cx [Cy Cz]],
    Ca as [DAx [DAy DAz]], Cb as [DBx [DBy DBz]], Cc as [DCx [DCy DCz]].
  assert (m <= f) by (unfold f; lra). assert (k <= h) by (unfold h; lra).
  assert (T : forall p q w p' q' w', Rabs (p - p') <= place -> Rabs (q - q') <= place ->
      Rabs (w - w') <= weight -> Rabs p <= m -> Rabs q <= m -> Rabs q' <= f -> Rabs w' <= h ->
      Rabs (p * q * w - p' * q' * w') <= 2 * (place * h * f) + f * f * weight).
  { intros p q w p' q' w' Dp Dq Dw Hp Hq Hq' Hw'.
    assert (I := product_off p q p' q' f f place place Dp Dq ltac:(lra) Hq').
    assert (J : Rabs (p * q) <= f * f) by (rewrite Rabs_mult; apply product_le; lra).
    assert (L := product_off _ w _ w' (f * f) h _ _ I Dw J Hw'). lra. }
  assert (t1 := T _ _ _ _ _ _ DAx DBy DCz Ax By_ By' Cz').
  assert (t2 := T _ _ _ _ _ _ DAy DBx DCz Ay Bx Bx' Cz').
  assert (t3 := T _ _ _ _ _ _ DAx DCy DBz Ax Cy Cy' Bz').
  assert (t4 := T _ _ _ _ _ _ DAy DCx DBz Ay Cx Cx' Bz').
  assert (W : forall p q w p' q' w', Rabs (p - p') <= place -> Rabs (q - q') <= place ->
      Rabs (w - w') <= weight -> Rabs p <= m -> Rabs q <= m -> Rabs q' <= f -> Rabs p' <= f -> Rabs w <= k ->
      Rabs (p * q * w - p' * q' * w') <= 2 * (place * h * f) + f * f * weight).
  { intros p q w p' q' w' Dp Dq Dw Hp Hq Hq' Hp' Hw.
    assert (I := product_off p q p' q' f f place place Dp Dq ltac:(lra) Hq').
    assert (J : Rabs (p' * q') <= f * f) by (rewrite Rabs_mult; apply product_le; lra).
    replace (p * q * w - p' * q' * w') with (w * (p * q) - w' * (p' * q')) by ring.
    assert (L := product_off w (p * q) w' (p' * q') h (f * f) _ _ Dw I ltac:(lra) J). lra. }
  assert (t5 := W _ _ _ _ _ _ DBx DCy DAz Bx Cy Cy' Bx' Az).
  assert (t6 := W _ _ _ _ _ _ DBy DCx DAz By_ Cx Cx' By' Az).
  apply Rabs_le_inv in t1, t2, t3, t4, t5, t6.
  apply Rabs_le. unfold det, dot, cross. simpl. lra.
Qed.
