(** The same in binary64: where the recorded test is true and t finite, t is T / D, rounded once.

    The stages are run as numpy runs them, on floats that may be infinite or NaN; nothing is assumed
    of overflow. What the test needs was finite then, all the way back: so it is what the real
    numbers of [QuotientWhole.v] say. *)
Require Import ZArith Reals Psatz String List Bool.
From Reftrace Require Import Trees Rounding Finite Digits ScalarProduct CrossProduct Ziv Quotient Overflow.
From Reftrace Require Import QuotientCode QuotientWhole QuotientFloats.
From Reftrace Require RecordedQuotient Geometry.
From Flocq Require Import Core BinarySingleNaN.
Import ListNotations.
Open Scope R_scope.
Open Scope string_scope.
Notation float := Trees.float.

(** ** Vectors, rays, surfaces *)

Record fvec := FVec { fx : float; fy : float; fz : float }.
Inductive fsurface := FCorners (a b c : fvec) | FPlane (point normal : fvec).

Definition vec_of (v : fvec) : Geometry.vec := Geometry.V (B2R (fx v)) (B2R (fy v)) (B2R (fz v)).
Definition ray_of (o d : fvec) : Geometry.ray := Geometry.Ray (vec_of o) (vec_of d).
Definition surface_of (s : fsurface) : surface :=
  match s with
  | FCorners a b c => Corners (Geometry.Triangle (vec_of a) (vec_of b) (vec_of c))
  | FPlane point normal => Plane (vec_of point) (vec_of normal)
  end.

Lemma floats_of v : all_floats (vec_of v).
Proof. repeat split; apply (generic_format_B2R prec emax). Qed.
Lemma ray_floats o d : float_ray (ray_of o d).
Proof. split; apply floats_of. Qed.
Lemma surface_floats s : float_surface (surface_of s).
Proof. destruct s; repeat split; apply (generic_format_B2R prec emax). Qed.

(** ** Stages *)

Definition nought : float := B754_zero false.
Definition fzero : fvec := FVec nought nought nought.
Fixpoint ffind (l : list (string * float)) (name : string) : float :=
  match l with
  | [] => nought
  | (known, x) :: rest => if String.eqb known name then x else ffind rest name
  end.
Definition fstage (l : list (string * float)) : env := Env (ffind l) (fun _ => false).
Definition fxyz (name : string) (v : fvec) : list (string * float) :=
  [(name ++ "x", fx v); (name ++ "y", fy v); (name ++ "z", fz v)].
Definition eval3 (v : env) (x y z : expr) : fvec := FVec (eval v x) (eval v y) (eval v z).

(** Two variables of the same name, and the same where the float is finite. *)
Definition alike (a : string * float) (b : string * R) : Prop :=
  fst a = fst b /\ (is_finite (snd a) = true -> B2R (snd a) = snd b).
Lemma stage_agrees l k : Forall2 alike l k -> agrees (fstage l) (stage k).
Proof.
  intros H name. simpl. induction H as [|[n x] [m y] l k [E A] H IH]; simpl; [easy|].
  cbn [fst snd] in E, A. subst m. now destruct (String.eqb n name).
Qed.
Lemma alike_xyz name v w : (is_finite (fx v) = true -> B2R (fx v) = px w) ->
  (is_finite (fy v) = true -> B2R (fy v) = py w) -> (is_finite (fz v) = true -> B2R (fz v) = pz w) ->
  Forall2 alike (fxyz name v) (xyz name w).
Proof. intros X Y Z. repeat constructor; assumption. Qed.
Lemma alike_given name v : Forall2 alike (fxyz name v) (xyz name (real (vec_of v))).
Proof. now apply alike_xyz. Qed.
Lemma alike_three v w name x y z : agrees v w -> arithmetic x = true -> arithmetic y = true -> arithmetic z = true ->
  Forall2 alike (fxyz name (eval3 v x y z)) (xyz name (fl3 w x y z)).
Proof. intros. apply alike_xyz; now apply finite_value. Qed.
Lemma alike_one v w name e : agrees v w -> arithmetic e = true -> alike (name, eval v e) (name, fl w e).
Proof. intros. split; [reflexivity|]. now apply finite_value. Qed.

(** ** The first stages *)

Definition fcorners (a b c : fvec) : env := fstage (fxyz "a" a ++ fxyz "b" b ++ fxyz "c" c).
Lemma corners_agree a b c :
  agrees (fcorners a b c) (corners (Geometry.Triangle (vec_of a) (vec_of b) (vec_of c))).
Proof. apply stage_agrees. repeat apply Forall2_app; apply alike_given. Qed.

Definition fhigh (s : fsurface) : fvec :=
  match s with
  | FCorners a b c => eval3 (fcorners a b c) RecordedQuotient.normal_x RecordedQuotient.normal_y RecordedQuotient.normal_z
  | FPlane _ normal => normal
  end.
Definition flow (s : fsurface) : fvec :=
  match s with
  | FCorners a b c =>
      eval3 (fcorners a b c) RecordedQuotient.normal_low_x RecordedQuotient.normal_low_y RecordedQuotient.normal_low_z
  | FPlane _ _ => fzero
  end.
Definition fM (s : fsurface) : float :=
  match s with FCorners a b c => eval (fcorners a b c) RecordedQuotient.normal_M | FPlane _ _ => nought end.
Definition fpoint (s : fsurface) : fvec := match s with FCorners a _ _ => a | FPlane point _ => point end.

Definition fentered (s : fsurface) (origin direction : fvec) (unit : float) : env :=
  fstage (fxyz "n" (fhigh s) ++ fxyz "n2" (flow s) ++ fxyz "p" (fpoint s) ++
    fxyz "o" origin ++ fxyz "d" direction ++ [("M", fM s); ("unit", unit)]).

Lemma M_finite s : is_finite (fM s) = true ->
  finite_error (surface_of s) /\ B2R (fM s) = normal_error (surface_of s).
Proof.
  destruct s as [a b c|p n]; [|easy]. intros F.
  exact (normal_error_value _ _ (corners_agree a b c) F).
Qed.

Lemma entered_agrees s o d unit runit : (is_finite unit = true -> B2R unit = runit) ->
  agrees (fentered s o d unit) (entered (surface_of s) (real (vec_of o)) (real (vec_of d)) runit).
Proof.
  intros U. apply stage_agrees. repeat apply Forall2_app; try apply alike_given.
  - destruct s; [|apply alike_given]. apply alike_three; [apply corners_agree | reflexivity..].
  - destruct s; [|now apply alike_xyz]. apply alike_three; [apply corners_agree | reflexivity..].
  - destruct s; apply alike_given.
  - repeat constructor; [apply M_finite | exact U].
Qed.

(** Where an error is finite, so is M. *)
Lemma size_finite s o d unit : is_finite (eval (fentered s o d unit) size_tree) = true ->
  finite_error (surface_of s).
Proof.
  intros F. apply M_finite. unfold size_tree in F. cbn [eval] in F. apply plus_finite in F.
  destruct F as [_ F]. apply mult_finite in F. apply F.
Qed.

Definition fcalled (v : env) (T1 T2 ET D1 D2 ED : expr) : env :=
  fstage [("T1", eval v T1); ("T2", eval v T2); ("ET", eval v ET); ("D1", eval v D1);
    ("D2", eval v D2); ("ED", eval v ED)].
Lemma called_agrees v w T1 T2 ET D1 D2 ED : agrees v w ->
  arithmetic T1 = true -> arithmetic T2 = true -> arithmetic D1 = true -> arithmetic D2 = true ->
  (is_finite (eval v ET) = true -> B2R (eval v ET) = fl w ET) ->
  (is_finite (eval v ED) = true -> B2R (eval v ED) = fl w ED) ->
  agrees (fcalled v T1 T2 ET D1 D2 ED) (called w T1 T2 ET D1 D2 ED).
Proof.
  intros G P1 P2 P3 P4 E1 E2. apply stage_agrees.
  repeat constructor; try assumption; now apply finite_value.
Qed.

(** ** From one origin *)

Definition fcolumn_from_point (s : fsurface) (origin : fvec) (unit : float) : env :=
  fentered s origin fzero unit.
Definition fmeeting_from_point (s : fsurface) (origin direction : fvec) (unit : float) : env :=
  let t := fcolumn_from_point s origin unit in
  let high := eval3 t RecordedQuotient.table_from_point_hx RecordedQuotient.table_from_point_hy RecordedQuotient.table_from_point_hz in
  let low := eval3 t RecordedQuotient.table_from_point_lx RecordedQuotient.table_from_point_ly RecordedQuotient.table_from_point_lz in
  fstage (fxyz "h" high ++ fxyz "l" low ++ fxyz "d" direction ++ [
    ("T1", eval t RecordedQuotient.table_from_point_T1); ("T2", eval t RecordedQuotient.table_from_point_T2);
    ("ET", eval t RecordedQuotient.table_from_point_ET); ("ED", eval t RecordedQuotient.table_from_point_ED); ("unit", unit)]).
Definition fmet_from_point (s : fsurface) (origin direction : fvec) (unit : float) : env :=
  fcalled (fmeeting_from_point s origin direction unit)
    RecordedQuotient.meet_from_point_T1 RecordedQuotient.meet_from_point_T2 RecordedQuotient.meet_from_point_ET
    RecordedQuotient.meet_from_point_D1 RecordedQuotient.meet_from_point_D2 RecordedQuotient.meet_from_point_ED.

(** [most]: the largest |d| of all rays, by component; of it only needs be true what is finite. *)
Theorem binary_from_point s o d most :
  let unit := eval (fstage (fxyz "d" most)) RecordedQuotient.unit_from_point in
  (is_finite unit = true -> within_of (real (vec_of d)) (real (vec_of most))) ->
  let v := fmet_from_point s o d unit in
  holds v RecordedQuotient.quotient_sure = true -> is_finite (eval v RecordedQuotient.quotient_t) = true ->
  let r := ray_of o d in
  D0 r (surface_of s) <> 0 /\
  B2R (eval v RecordedQuotient.quotient_t) = rnd (T0 r (surface_of s) / D0 r (surface_of s)).
Proof.
  intros unit W v Q F r. set (runit := unit_of_directions (real (vec_of most))).
  assert (U : is_finite unit = true -> B2R unit = runit).
  { apply finite_value; [|reflexivity]. apply stage_agrees, alike_given. }
  set (t := fcolumn_from_point s o unit). set (u := column_from_point (surface_of s) (real (vec_of o)) runit).
  assert (G : agrees t u) by exact (entered_agrees s o fzero unit runit U).
  assert (ET := error_value t u reach_tree size_tree G eq_refl eq_refl).
  assert (ED := error_value t u (Var "unit") size_tree G eq_refl eq_refl).
  set (w := met_from_point (surface_of s) (real (vec_of o)) (real (vec_of d)) runit).
  assert (H : agrees (fmeeting_from_point s o d unit)
    (meeting_from_point (surface_of s) (real (vec_of o)) (real (vec_of d)) runit)).
  { apply stage_agrees. repeat apply Forall2_app; try apply alike_given;
      try (apply alike_three; [exact G | reflexivity..]).
    repeat apply Forall2_cons; try apply Forall2_nil;
      try (apply alike_one; [exact G | reflexivity]); split; [reflexivity| |reflexivity| |reflexivity|];
      [apply ET | apply ED | exact U]. }
  assert (K : agrees v w) by (apply called_agrees; auto; now apply finite_value).
  destruct (quotient_value v w K Q F) as [Q' [-> V]].
  destruct ET as [ET1 [_ [_ ET2]]]; [apply (V "ET"); simpl; tauto|].
  destruct ED as [ED1 [_ [ED2 _]]]; [apply (V "ED"); simpl; tauto|].
  refine (recorded_from_point _ r _ (surface_floats s) (ray_floats o d) (W ED2) _ Q').
  split; [exact (size_finite s _ _ _ ET2) | split; [exact ET1 | exact ED1]].
Qed.

(** ** Along one direction *)

Definition fcolumn_parallel (s : fsurface) (first direction : fvec) (unit : float) : env :=
  fentered s first direction unit.
Definition fmeeting_parallel (s : fsurface) (first origin direction : fvec) (unit : float) : env :=
  let t := fcolumn_parallel s first direction unit in
  let high := eval3 t RecordedQuotient.table_parallel_hx RecordedQuotient.table_parallel_hy RecordedQuotient.table_parallel_hz in
  let low := eval3 t RecordedQuotient.table_parallel_lx RecordedQuotient.table_parallel_ly RecordedQuotient.table_parallel_lz in
  fstage (fxyz "h" high ++ fxyz "l" low ++ fxyz "q" origin ++ fxyz "o" first ++ [
    ("T1", eval t RecordedQuotient.table_parallel_T1); ("T2", eval t RecordedQuotient.table_parallel_T2);
    ("ET", eval t RecordedQuotient.table_parallel_ET); ("D1", eval t RecordedQuotient.table_parallel_D1);
    ("D2", eval t RecordedQuotient.table_parallel_D2); ("ED", eval t RecordedQuotient.table_parallel_ED); ("unit", unit)]).
Definition fmet_parallel (s : fsurface) (first origin direction : fvec) (unit : float) : env :=
  fcalled (fmeeting_parallel s first origin direction unit)
    RecordedQuotient.meet_parallel_T1 RecordedQuotient.meet_parallel_T2 RecordedQuotient.meet_parallel_ET
    RecordedQuotient.meet_parallel_D1 RecordedQuotient.meet_parallel_D2 RecordedQuotient.meet_parallel_ED.

(** [most]: of the rays' origins, less the first of them, the largest by component. *)
Theorem binary_parallel s f o d most :
  let unit := eval (fstage (fxyz "v" most)) RecordedQuotient.power_above in
  (is_finite unit = true -> within_of (apart (real (vec_of o)) (real (vec_of f))) (real (vec_of most))) ->
  let v := fmet_parallel s f o d unit in
  holds v RecordedQuotient.quotient_sure = true -> is_finite (eval v RecordedQuotient.quotient_t) = true ->
  let r := ray_of o d in
  D0 r (surface_of s) <> 0 /\
  B2R (eval v RecordedQuotient.quotient_t) = rnd (T0 r (surface_of s) / D0 r (surface_of s)).
Proof.
  intros unit W v Q F r. set (runit := unit_of_origins (real (vec_of most))).
  assert (U : is_finite unit = true -> B2R unit = runit).
  { apply finite_value; [|reflexivity]. apply stage_agrees, alike_given. }
  set (t := fcolumn_parallel s f d unit).
  set (u := column_parallel (surface_of s) (real (vec_of f)) (real (vec_of d)) runit).
  assert (G : agrees t u) by exact (entered_agrees s f d unit runit U).
  assert (E1 := error_value t u reach_tree size_tree G eq_refl eq_refl).
  assert (E2 := error_value t u (Var "unit") size_tree G eq_refl eq_refl).
  assert (ED := error_value t u along_tree size_tree G eq_refl eq_refl).
  assert (ET : is_finite (eval t RecordedQuotient.table_parallel_ET) = true ->
    (no_inf u RecordedQuotient.table_parallel_ET = true /\ is_finite unit = true /\ finite_error (surface_of s)) /\
    B2R (eval t RecordedQuotient.table_parallel_ET) = fl u RecordedQuotient.table_parallel_ET).
  { change RecordedQuotient.table_parallel_ET
      with (Add (error_tree reach_tree size_tree) (error_tree (Var "unit") size_tree)).
    cbn [eval]. intros S. assert (S' := plus_value _ _ S). apply plus_finite in S. destruct S as [S1 S2].
    destruct (E1 S1) as [A1 [A2 [_ A3]]]. destruct (E2 S2) as [B1 [B2 [B3 _]]].
    rewrite S', A2, B2. cbn [no_inf]. split; [|reflexivity]. split; [|split; [exact B3|]].
    - apply andb_true_intro. split; [exact A1 | exact B1].
    - exact (size_finite s _ _ _ A3). }
  set (w := met_parallel (surface_of s) (real (vec_of f)) (real (vec_of o)) (real (vec_of d)) runit).
  assert (H : agrees (fmeeting_parallel s f o d unit)
    (meeting_parallel (surface_of s) (real (vec_of f)) (real (vec_of o)) (real (vec_of d)) runit)).
  { apply stage_agrees. repeat apply Forall2_app; try apply alike_given;
      try (apply alike_three; [exact G | reflexivity..]).
    repeat apply Forall2_cons; try apply Forall2_nil;
      try (apply alike_one; [exact G | reflexivity]); split; [reflexivity| |reflexivity| |reflexivity|];
      [apply ET | apply ED | exact U]. }
  assert (K : agrees v w) by (apply called_agrees; auto; now apply finite_value).
  destruct (quotient_value v w K Q F) as [Q' [-> V]].
  destruct ET as [[ET1 [ET2 ET3]] _]; [apply (V "ET"); simpl; tauto|].
  destruct ED as [ED1 _]; [apply (V "ED"); simpl; tauto|].
  refine (recorded_parallel _ r _ _ (surface_floats s) (ray_floats o d) (floats_of f) (W ET2) _ Q').
  split; [exact ET3 | split; [exact ET1 | exact ED1]].
Qed.

(** ** Rays that share nothing *)

Definition fcolumn_alone (s : fsurface) : env := fentered s fzero fzero nought.
Definition fmeeting_alone (s : fsurface) (origin direction : fvec) : env :=
  let t := fcolumn_alone s in
  let high := eval3 t RecordedQuotient.table_alone_hx RecordedQuotient.table_alone_hy RecordedQuotient.table_alone_hz in
  let low := eval3 t RecordedQuotient.table_alone_lx RecordedQuotient.table_alone_ly RecordedQuotient.table_alone_lz in
  let point := eval3 t RecordedQuotient.table_alone_px RecordedQuotient.table_alone_py RecordedQuotient.table_alone_pz in
  fstage (fxyz "h" high ++ fxyz "l" low ++ fxyz "p" point ++ fxyz "o" origin ++ fxyz "d" direction ++ [
    ("size", eval t RecordedQuotient.table_alone_size)]).
Definition fmet_alone (s : fsurface) (origin direction : fvec) : env :=
  fcalled (fmeeting_alone s origin direction)
    RecordedQuotient.meet_alone_T1 RecordedQuotient.meet_alone_T2 RecordedQuotient.meet_alone_ET
    RecordedQuotient.meet_alone_D1 RecordedQuotient.meet_alone_D2 RecordedQuotient.meet_alone_ED.

Theorem binary_alone s o d :
  let v := fmet_alone s o d in
  holds v RecordedQuotient.quotient_sure = true -> is_finite (eval v RecordedQuotient.quotient_t) = true ->
  let r := ray_of o d in
  D0 r (surface_of s) <> 0 /\
  B2R (eval v RecordedQuotient.quotient_t) = rnd (T0 r (surface_of s) / D0 r (surface_of s)).
Proof.
  intros v Q F r. set (t := fcolumn_alone s). set (u := column_alone (surface_of s)).
  assert (G : agrees t u) by exact (entered_agrees s fzero fzero nought 0 (fun _ => eq_refl)).
  set (m := fmeeting_alone s o d).
  set (n := meeting_alone (surface_of s) (real (vec_of o)) (real (vec_of d))).
  assert (H : agrees m n).
  { apply stage_agrees. repeat apply Forall2_app; try apply alike_given;
      try (apply alike_three; [exact G | reflexivity..]).
    apply Forall2_cons; [|apply Forall2_nil]. apply alike_one; [exact G | reflexivity]. }
  assert (ET := error_value m n reach_tree (Var "size") H eq_refl eq_refl).
  assert (ED := error_value m n along_tree (Var "size") H eq_refl eq_refl).
  set (w := met_alone (surface_of s) (real (vec_of o)) (real (vec_of d))).
  assert (K : agrees v w).
  { apply called_agrees; auto; [apply ET | apply ED]. }
  destruct (quotient_value v w K Q F) as [Q' [-> V]].
  destruct ET as [ET1 [_ [_ ET2]]]; [apply (V "ET"); simpl; tauto|].
  destruct ED as [ED1 _]; [apply (V "ED"); simpl; tauto|].
  refine (recorded_alone _ r (surface_floats s) (ray_floats o d) _ Q').
  split; [exact (size_finite s _ _ _ ET2) | split; [exact ET1 | exact ED1]].
Qed.

(** ** The tests can be passed: a triangle, of small numbers, and a ray in each of the three ways *)

Section Example.
Let at_ x y z := FVec (num x (-4)) (num y (-4)) (num z (-4)).
Let s := FCorners (at_ (-17) (-15) (-83)) (at_ 21 (-13) (-91)) (at_ 3 22 (-78)).
Let o := at_ 2 1 5.
Let f := at_ 3 (-1) 4.
Let d := at_ 1 2 (-16).
Let passes v := holds v RecordedQuotient.quotient_sure && is_finite (eval v RecordedQuotient.quotient_t).

Theorem some_pass :
  passes (fmet_from_point s o d (eval (fstage (fxyz "d" d)) RecordedQuotient.unit_from_point)) &&
  passes (fmet_parallel s f o d (eval (fstage (fxyz "v" (at_ 1 2 1))) RecordedQuotient.power_above)) &&
  passes (fmet_alone s o d) = true.
Proof. vm_compute. reflexivity. Qed.
End Example.
