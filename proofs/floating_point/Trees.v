(** Expressions as numpy executes them, and what they are worth: in binary64, and exactly.

    recorded/ holds the expressions that a test has seen the tracer execute; here is the language
    that they are written in. Every operation is one of IEEE 754's, rounded to the nearest binary64,
    ties to even, with gradual underflow, infinities and NaN: the model is Flocq's. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
Open Scope R_scope.

Definition prec := 53%Z.
Definition emax := 1024%Z.
#[global] Instance prec_gt_0 : Prec_gt_0 prec. Proof. reflexivity. Qed.
#[global] Instance prec_lt_emax : Prec_lt_emax prec emax. Proof. reflexivity. Qed.

Definition float := binary_float prec emax.
Definition fexp := FLT_exp (-1074) prec.
#[global] Instance fexp_valid : Valid_exp fexp := FLT_exp_valid (-1074) prec.

(** A real number, rounded; as if there were no largest float. *)
Definition rnd (x : R) : R := round radix2 fexp ZnearestE x.
Definition is_float (x : R) : Prop := generic_format radix2 fexp x.

(** [Keep n x]: only the n highest digits of x's 53 (bits are masked away in [quotient.py]). *)
Inductive expr :=
| Var (name : string)
| Num (m e : Z) (* m 2^e *)
| Inf
| Add (a b : expr) | Sub (a b : expr) | Mul (a b : expr) | Div (a b : expr)
| Abs (a : expr) | Neg (a : expr)
| Max (a b : expr) | Min (a b : expr)
| Next (a : expr) (* the float above *) | Prev (a : expr) (* the float below *)
| Floor (a : expr) | Ceil (a : expr)
| CopySign (a b : expr)
| Keep (n : Z) (a : expr)
| Where (c : test) (a b : expr)
with test :=
| Less (a b : expr) | LessEq (a b : expr) | Same (a b : expr)
| And (c d : test) | Or (c d : test) | Not (c : test)
| Finite (a : expr)
| Given (name : string). (* what is true or false of the input *)

(** ** In binary64 *)

Definition fmax (a b : float) : float := (* numpy's: of NaN, NaN *)
  match Bcompare a b with Some Lt => b | Some _ => a | None => B754_nan end.
Definition fmin (a b : float) : float :=
  match Bcompare a b with Some Gt => b | Some _ => a | None => B754_nan end.
Definition num (m e : Z) : float := binary_normalize prec emax _ _ mode_NE m e false.

(** Bits masked away. Of 53 digits the n highest remain; also of what has fewer. Of inf all remains; of
    NaN's bits the exponent alone is inf's, and more are NaN's. *)
Definition keep (n : Z) (x : float) : float :=
  match x with
  | B754_finite s m e _ =>
      let unit := (2 ^ (53 - n))%Z in
      binary_normalize prec emax _ _ mode_NE (Z.quot (cond_Zopp s (Z.pos m)) unit * unit) e s
  | B754_nan => if Z.eqb n 1 then B754_infinity false else B754_nan
  | _ => x
  end.

Record env := Env { of_var : string -> float; of_given : string -> bool }.

(** [CopySign] has no value here (NaN stands for that): it copies the sign of a NaN, too, and Flocq's NaN
    has none. *)
Fixpoint eval (v : env) (e : expr) : float :=
  match e with
  | Var name => of_var v name
  | Num m e => num m e
  | Inf => B754_infinity false
  | Add a b => Bplus mode_NE (eval v a) (eval v b)
  | Sub a b => Bminus mode_NE (eval v a) (eval v b)
  | Mul a b => Bmult mode_NE (eval v a) (eval v b)
  | Div a b => Bdiv mode_NE (eval v a) (eval v b)
  | Abs a => Babs (eval v a)
  | Neg a => Bopp (eval v a)
  | Max a b => fmax (eval v a) (eval v b)
  | Min a b => fmin (eval v a) (eval v b)
  | Next a => Bsucc (eval v a)
  | Prev a => Bpred (eval v a)
  | Floor a => Bnearbyint mode_DN (eval v a)
  | Ceil a => Bnearbyint mode_UP (eval v a)
  | CopySign _ _ => B754_nan
  | Keep n a => keep n (eval v a)
  | Where c a b => if holds v c then eval v a else eval v b
  end
with holds (v : env) (c : test) : bool :=
  match c with
  | Less a b => match Bcompare (eval v a) (eval v b) with Some Lt => true | _ => false end
  | LessEq a b =>
      match Bcompare (eval v a) (eval v b) with Some Lt | Some Eq => true | _ => false end
  | Same a b => match Bcompare (eval v a) (eval v b) with Some Eq => true | _ => false end
  | And c d => holds v c && holds v d
  | Or c d => holds v c || holds v d
  | Not c => negb (holds v c)
  | Finite a => is_finite (eval v a)
  | Given name => of_given v name
  end.

(** ** In real numbers *)

Record renv := REnv { r_var : string -> R; r_given : string -> bool }.

(** As if no result were too large for a float: every operation rounded by [rd]. *)
Fixpoint value (rd : R -> R) (v : renv) (e : expr) : R :=
  match e with
  | Var name => r_var v name
  | Num m e => IZR m * bpow radix2 e
  | Inf => 0
  | Add a b => rd (value rd v a + value rd v b)
  | Sub a b => rd (value rd v a - value rd v b)
  | Mul a b => rd (value rd v a * value rd v b)
  | Div a b => rd (value rd v a / value rd v b)
  | Abs a => Rabs (value rd v a)
  | Neg a => - value rd v a
  | Max a b => Rmax (value rd v a) (value rd v b)
  | Min a b => Rmin (value rd v a) (value rd v b)
  | Next a => succ radix2 fexp (value rd v a)
  | Prev a => pred radix2 fexp (value rd v a)
  | Floor a => IZR (Zfloor (value rd v a))
  | Ceil a => IZR (Zceil (value rd v a))
  | CopySign a b =>
      if Rlt_bool (value rd v b) 0 then - Rabs (value rd v a) else Rabs (value rd v a)
  | Keep n a => round radix2 (FLT_exp (-1074 + prec - n) n) Ztrunc (value rd v a)
  | Where c a b => if truth rd v c then value rd v a else value rd v b
  end
with truth (rd : R -> R) (v : renv) (c : test) : bool :=
  match c with
  | Less a b => Rlt_bool (value rd v a) (value rd v b)
  | LessEq a b => Rle_bool (value rd v a) (value rd v b)
  | Same a b => Req_bool (value rd v a) (value rd v b)
  | And c d => truth rd v c && truth rd v d
  | Or c d => truth rd v c || truth rd v d
  | Not c => negb (truth rd v c)
  | Finite _ => true
  | Given name => r_given v name
  end.

(** What the tracer computes, and what it would without any rounding. *)
Notation fl := (value rnd).
Notation ex := (value (fun x => x)).

Definition real_env (v : env) : renv := REnv (fun name => B2R (of_var v name)) (of_given v).

(** ** The two agree where nothing overflows *)

Lemma rnd_round x : rnd x = round radix2 (SpecFloat.fexp prec emax) (round_mode mode_NE) x.
Proof. reflexivity. Qed.

(** The numbers that are written in the code are floats: [num] does not round. *)
Lemma number_float m e : (Z.abs m < 2 ^ 53)%Z -> (-1074 <= e)%Z -> is_float (IZR m * bpow radix2 e).
Proof. intros M E. apply generic_format_FLT. now exists (Float radix2 m e). Qed.
Lemma int_float n : (Z.abs n < 2 ^ 53)%Z -> is_float (IZR n).
Proof. intros H. rewrite <- (Rmult_1_r (IZR n)). now apply (number_float n 0). Qed.
Lemma num_value m e : (Z.abs m < 2 ^ 53)%Z -> (-1074 <= e)%Z -> is_finite (num m e) = true ->
  B2R (num m e) = IZR m * bpow radix2 e.
Proof.
  intros M E. generalize (binary_normalize_correct prec emax _ _ mode_NE m e false). fold (num m e).
  cbv zeta. change (F2R (Float radix2 m e)) with (IZR m * bpow radix2 e).
  rewrite round_generic by (apply valid_rnd_N || now apply number_float).
  case Rlt_bool; [now intros [V _]|]. generalize (num m e). intros [ | | | ]; discriminate.
Qed.

Lemma plus_finite x y : is_finite (Bplus mode_NE x y : float) = true ->
  is_finite x = true /\ is_finite y = true.
Proof. destruct x as [[]|[]| |[] ? ? ?], y as [[]|[]| |[] ? ? ?]; simpl; auto; discriminate. Qed.
Lemma minus_finite x y : is_finite (Bminus mode_NE x y : float) = true ->
  is_finite x = true /\ is_finite y = true.
Proof. destruct x as [[]|[]| |[] ? ? ?], y as [[]|[]| |[] ? ? ?]; simpl; auto; discriminate. Qed.
Lemma mult_finite x y : is_finite (Bmult mode_NE x y : float) = true ->
  is_finite x = true /\ is_finite y = true.
Proof. destruct x as [[]|[]| |[] ? ? ?], y as [[]|[]| |[] ? ? ?]; simpl; auto; discriminate. Qed.

(** A result that is finite is the rounded one. *)
Lemma plus_value x y : is_finite (Bplus mode_NE x y : float) = true ->
  B2R (Bplus mode_NE x y) = rnd (B2R x + B2R y).
Proof.
  intros F. destruct (plus_finite x y F) as [Fx Fy].
  generalize (Bplus_correct prec emax _ _ mode_NE x y Fx Fy). intros H.
  revert H. case Rlt_bool_spec; intros _ H; [exact (proj1 H)|].
  exfalso. destruct H as [H _]. revert F H. generalize (Bplus mode_NE x y).
  intros [ | | | ]; simpl; intros; discriminate.
Qed.
Lemma minus_value x y : is_finite (Bminus mode_NE x y : float) = true ->
  B2R (Bminus mode_NE x y) = rnd (B2R x - B2R y).
Proof.
  intros F. destruct (minus_finite x y F) as [Fx Fy].
  generalize (Bminus_correct prec emax _ _ mode_NE x y Fx Fy). intros H.
  revert H. case Rlt_bool_spec; intros _ H; [exact (proj1 H)|].
  exfalso. destruct H as [H _]. revert F H. generalize (Bminus mode_NE x y).
  intros [ | | | ]; simpl; intros; discriminate.
Qed.
Lemma mult_value x y : is_finite (Bmult mode_NE x y : float) = true ->
  B2R (Bmult mode_NE x y) = rnd (B2R x * B2R y).
Proof.
  intros F.
  generalize (Bmult_correct prec emax _ _ mode_NE x y). intros H.
  revert H. case Rlt_bool_spec; intros _ H; [exact (proj1 H)|].
  exfalso. revert F H. generalize (Bmult mode_NE x y).
  intros [ | | | ]; simpl; intros; discriminate.
Qed.
