/* foamprb view: three.js, uPlot (MIT) and foamprb (GPL-3.0-or-later); sources a86d02d202fc9184 */
(()=>{var mp=0,wu=1,gp=2;var fa=1,_p=2,co=3,yi=0,pn=1,Si=2,cr=0,ho=1,Au=2,Tu=3,Eu=4,xp=5;var hr=100,vp=101,yp=102,Sp=103,Mp=104,bp=200,wp=201,Ap=202,Tp=203,Cu=204,Ru=205,Ep=206,Cp=207,Rp=208,Pp=209,Ip=210,Lp=211,Dp=212,Np=213,Up=214,Sl=0,Ml=1,bl=2,eo=3,wl=4,Al=5,Tl=6,El=7,Pu=0,Fp=1,Op=2,Ki=0,Iu=1,Lu=2,Du=3,Nu=4,Uu=5,Fu=6,Ou=7;var Bu=300,ur=301,uo=302,nc=303,ic=304,Cl=1e3,Yi=1001,Rl=1002,fn=1003,Bp=1004;var da=1005;var dn=1006,sc=1007;var vs=1008;var li=1009,zu=1010,ku=1011,fo=1012,rc=1013,Di=1014,Ni=1015,Ui=1016,oc=1017,ac=1018,fr=1020,Vu=35902,Gu=35899,Hu=1021,Wu=1022,ci=1023,gs=1026,ys=1027,pa=1028,lc=1029,Hs=1030,cc=1031;var hc=1033,ma=33776,ga=33777,_a=33778,xa=33779,uc=35840,fc=35841,dc=35842,pc=35843,mc=36196,gc=37492,_c=37496,xc=37488,vc=37489,va=37490,yc=37491,Sc=37808,Mc=37809,bc=37810,wc=37811,Ac=37812,Tc=37813,Ec=37814,Cc=37815,Rc=37816,Pc=37817,Ic=37818,Lc=37819,Dc=37820,Nc=37821,Uc=36492,Fc=36494,Oc=36495,Bc=36283,zc=36284,ya=36285,kc=36286;var $o=2300,Pl=2301,vl=2302,gu=2303,_u=2400,xu=2401,vu=2402;var zp=3200;var Xu=0,kp=1,Ss="",si="srgb",ir="srgb-linear",Zo="linear",Tt="srgb";var yl=7680;var qu=34055,Yu=34056;var $u=517;var Vc=519,Vp=512,Gp=513,Hp=514,Zu=515,Wp=516,Xp=517,Ju=518,Ku=519,ju=35044,Qu=35048;var Mi="300 es",xi=2e3,Jo=2001;function g_(i){for(let e=i.length-1;e>=0;--e)if(i[e]>=65535)return!0;return!1}function __(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function Ko(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function qp(){let i=Ko("canvas");return i.style.display="block",i}var zd={},to=null;function jo(...i){let e="THREE."+i.shift();to?to("log",e,...i):console.log(e,...i)}function Yp(i){let e=i[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=i[1];t&&t.isStackTrace?i[0]+=" "+t.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function Je(...i){i=Yp(i);let e="THREE."+i.shift();if(to)to("warn",e,...i);else{let t=i[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...i)}}function et(...i){i=Yp(i);let e="THREE."+i.shift();if(to)to("error",e,...i);else{let t=i[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...i)}}function Yo(...i){let e=i.join(" ");e in zd||(zd[e]=!0,Je(...i))}function $p(i,e,t){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(e,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:n()}}setTimeout(r,t)})}var Zp={[Sl]:Sl,[bl]:Tl,[wl]:wl,[eo]:Al,[Ml]:Ml,[Tl]:bl,[El]:El,[Al]:eo},$i=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[e]===void 0&&(n[e]=[]),n[e].indexOf(t)===-1&&n[e].push(t)}hasEventListener(e,t){let n=this._listeners;return n===void 0?!1:n[e]!==void 0&&n[e].indexOf(t)!==-1}removeEventListener(e,t){let n=this._listeners;if(n===void 0)return;let s=n[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let n=t[e.type];if(n!==void 0){e.target=this;let s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,e);e.target=null}}},Un=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"];var $h=Math.PI/180,Il=180/Math.PI;function dr(){let i=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(Un[i&255]+Un[i>>8&255]+Un[i>>16&255]+Un[i>>24&255]+"-"+Un[e&255]+Un[e>>8&255]+"-"+Un[e>>16&15|64]+Un[e>>24&255]+"-"+Un[t&63|128]+Un[t>>8&255]+"-"+Un[t>>16&255]+Un[t>>24&255]+Un[n&255]+Un[n>>8&255]+Un[n>>16&255]+Un[n>>24&255]).toLowerCase()}function yt(i,e,t){return Math.max(e,Math.min(t,i))}function x_(i,e){return(i%e+e)%e}function Zh(i,e,t){return(1-t)*i+t*e}function Jp(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function Gc(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function Kp(i,e){if(e.constructor===Float32Array)return i;let t=Gc(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/t,-1)}function jp(i,e){if(e.constructor===Float32Array)return i;let t=Gc(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*t)}var xt=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,n=this.y,s=e.elements;return this.x=s[0]*t+s[3]*n+s[6],this.y=s[1]*t+s[4]*n+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=yt(this.x,e.x,t.x),this.y=yt(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=yt(this.x,e,t),this.y=yt(this.y,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(yt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(yt(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y;return t*t+n*n}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let n=Math.cos(t),s=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*n-o*s+e.x,this.y=r*s+o*n+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},Zi=class{constructor(e=0,t=0,n=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=n,this._w=s}static slerpFlat(e,t,n,s,r,o,a){let l=n[s+0],c=n[s+1],f=n[s+2],u=n[s+3],h=r[o+0],p=r[o+1],g=r[o+2],v=r[o+3];if(u!==v||l!==h||c!==p||f!==g){let d=l*h+c*p+f*g+u*v;d<0&&(h=-h,p=-p,g=-g,v=-v,d=-d);let m=1-a;if(d<.9995){let y=Math.acos(d),T=Math.sin(y);m=Math.sin(m*y)/T,a=Math.sin(a*y)/T,l=l*m+h*a,c=c*m+p*a,f=f*m+g*a,u=u*m+v*a}else{l=l*m+h*a,c=c*m+p*a,f=f*m+g*a,u=u*m+v*a;let y=1/Math.sqrt(l*l+c*c+f*f+u*u);l*=y,c*=y,f*=y,u*=y}}e[t]=l,e[t+1]=c,e[t+2]=f,e[t+3]=u}static multiplyQuaternionsFlat(e,t,n,s,r,o){let a=n[s],l=n[s+1],c=n[s+2],f=n[s+3],u=r[o],h=r[o+1],p=r[o+2],g=r[o+3];return e[t]=a*g+f*u+l*p-c*h,e[t+1]=l*g+f*h+c*u-a*p,e[t+2]=c*g+f*p+a*h-l*u,e[t+3]=f*g-a*u-l*h-c*p,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,n,s){return this._x=e,this._y=t,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let n=e._x,s=e._y,r=e._z,o=e._order,a=Math.cos,l=Math.sin,c=a(n/2),f=a(s/2),u=a(r/2),h=l(n/2),p=l(s/2),g=l(r/2);switch(o){case"XYZ":this._x=h*f*u+c*p*g,this._y=c*p*u-h*f*g,this._z=c*f*g+h*p*u,this._w=c*f*u-h*p*g;break;case"YXZ":this._x=h*f*u+c*p*g,this._y=c*p*u-h*f*g,this._z=c*f*g-h*p*u,this._w=c*f*u+h*p*g;break;case"ZXY":this._x=h*f*u-c*p*g,this._y=c*p*u+h*f*g,this._z=c*f*g+h*p*u,this._w=c*f*u-h*p*g;break;case"ZYX":this._x=h*f*u-c*p*g,this._y=c*p*u+h*f*g,this._z=c*f*g-h*p*u,this._w=c*f*u+h*p*g;break;case"YZX":this._x=h*f*u+c*p*g,this._y=c*p*u+h*f*g,this._z=c*f*g-h*p*u,this._w=c*f*u-h*p*g;break;case"XZY":this._x=h*f*u-c*p*g,this._y=c*p*u-h*f*g,this._z=c*f*g+h*p*u,this._w=c*f*u+h*p*g;break;default:Je("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let n=t/2,s=Math.sin(n);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,n=t[0],s=t[4],r=t[8],o=t[1],a=t[5],l=t[9],c=t[2],f=t[6],u=t[10],h=n+a+u;if(h>0){let p=.5/Math.sqrt(h+1);this._w=.25/p,this._x=(f-l)*p,this._y=(r-c)*p,this._z=(o-s)*p}else if(n>a&&n>u){let p=2*Math.sqrt(1+n-a-u);this._w=(f-l)/p,this._x=.25*p,this._y=(s+o)/p,this._z=(r+c)/p}else if(a>u){let p=2*Math.sqrt(1+a-n-u);this._w=(r-c)/p,this._x=(s+o)/p,this._y=.25*p,this._z=(l+f)/p}else{let p=2*Math.sqrt(1+u-n-a);this._w=(o-s)/p,this._x=(r+c)/p,this._y=(l+f)/p,this._z=.25*p}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let n=e.dot(t)+1;return n<1e-8?(n=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=n):(this._x=0,this._y=-e.z,this._z=e.y,this._w=n)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=n),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(yt(this.dot(e),-1,1)))}rotateTowards(e,t){let n=this.angleTo(e);if(n===0)return this;let s=Math.min(1,t/n);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=t._x,l=t._y,c=t._z,f=t._w;return this._x=n*f+o*a+s*c-r*l,this._y=s*f+o*l+r*a-n*c,this._z=r*f+o*c+n*l-s*a,this._w=o*f-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(n=-n,s=-s,r=-r,o=-o,a=-a);let l=1-t;if(a<.9995){let c=Math.acos(a),f=Math.sin(c);l=Math.sin(l*c)/f,t=Math.sin(t*c)/f,this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this._onChangeCallback()}else this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this.normalize();return this}slerpQuaternions(e,t,n){return this.copy(e).slerp(t,n)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},W=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,n=0){this.x=e,this.y=t,this.z=n}set(e,t,n){return n===void 0&&(n=this.z),this.x=e,this.y=t,this.z=n,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(kd.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(kd.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*n+r[6]*s,this.y=r[1]*t+r[4]*n+r[7]*s,this.z=r[2]*t+r[5]*n+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=e.elements,o=1/(r[3]*t+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*t+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*t+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(e){let t=this.x,n=this.y,s=this.z,r=e.x,o=e.y,a=e.z,l=e.w,c=2*(o*s-a*n),f=2*(a*t-r*s),u=2*(r*n-o*t);return this.x=t+l*c+o*u-a*f,this.y=n+l*f+a*c-r*u,this.z=s+l*u+r*f-o*c,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*n+r[8]*s,this.y=r[1]*t+r[5]*n+r[9]*s,this.z=r[2]*t+r[6]*n+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=yt(this.x,e.x,t.x),this.y=yt(this.y,e.y,t.y),this.z=yt(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=yt(this.x,e,t),this.y=yt(this.y,e,t),this.z=yt(this.z,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(yt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let n=e.x,s=e.y,r=e.z,o=t.x,a=t.y,l=t.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let n=e.dot(this)/t;return this.copy(e).multiplyScalar(n)}projectOnPlane(e){return Jh.copy(this).projectOnVector(e),this.sub(Jh)}reflect(e){return this.sub(Jh.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(yt(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y,s=this.z-e.z;return t*t+n*n+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,n){let s=Math.sin(t)*e;return this.x=s*Math.sin(n),this.y=Math.cos(t)*e,this.z=s*Math.cos(n),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,n){return this.x=e*Math.sin(t),this.y=n,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),n=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=n,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,n=Math.sqrt(1-t*t);return this.x=n*Math.cos(e),this.y=t,this.z=n*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Jh=new W,kd=new Zi,nt=class{static{this.prototype.isMatrix3=!0}constructor(e,t,n,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c)}set(e,t,n,s,r,o,a,l,c){let f=this.elements;return f[0]=e,f[1]=s,f[2]=a,f[3]=t,f[4]=r,f[5]=l,f[6]=n,f[7]=o,f[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],this}extractBasis(e,t,n){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],f=n[4],u=n[7],h=n[2],p=n[5],g=n[8],v=s[0],d=s[3],m=s[6],y=s[1],T=s[4],S=s[7],C=s[2],E=s[5],_=s[8];return r[0]=o*v+a*y+l*C,r[3]=o*d+a*T+l*E,r[6]=o*m+a*S+l*_,r[1]=c*v+f*y+u*C,r[4]=c*d+f*T+u*E,r[7]=c*m+f*S+u*_,r[2]=h*v+p*y+g*C,r[5]=h*d+p*T+g*E,r[8]=h*m+p*S+g*_,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],f=e[8];return t*o*f-t*a*c-n*r*f+n*a*l+s*r*c-s*o*l}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],f=e[8],u=f*o-a*c,h=a*l-f*r,p=c*r-o*l,g=t*u+n*h+s*p;if(g===0)return this.set(0,0,0,0,0,0,0,0,0);let v=1/g;return e[0]=u*v,e[1]=(s*c-f*n)*v,e[2]=(a*n-s*o)*v,e[3]=h*v,e[4]=(f*t-s*l)*v,e[5]=(s*r-a*t)*v,e[6]=p*v,e[7]=(n*l-c*t)*v,e[8]=(o*t-n*r)*v,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,n,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+e,-s*c,s*l,-s*(-c*o+l*a)+a+t,0,0,1),this}scale(e,t){return Yo("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(Kh.makeScale(e,t)),this}rotate(e){return Yo("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(Kh.makeRotation(-e)),this}translate(e,t){return Yo("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(Kh.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,n,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<9;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<9;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e}clone(){return new this.constructor().fromArray(this.elements)}},Kh=new nt,Vd=new nt().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Gd=new nt().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function v_(){let i={enabled:!0,workingColorSpace:ir,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===Tt&&(s.r=ms(s.r),s.g=ms(s.g),s.b=ms(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===Tt&&(s.r=Qr(s.r),s.g=Qr(s.g),s.b=Qr(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Ss?Zo:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[ir]:{primaries:e,whitePoint:n,transfer:Zo,toXYZ:Vd,fromXYZ:Gd,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:si},outputColorSpaceConfig:{drawingBufferColorSpace:si}},[si]:{primaries:e,whitePoint:n,transfer:Tt,toXYZ:Vd,fromXYZ:Gd,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:si}}}),i}var mt=v_();function ms(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function Qr(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var kr,Ll=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let n;if(e instanceof HTMLCanvasElement)n=e;else{kr===void 0&&(kr=Ko("canvas")),kr.width=e.width,kr.height=e.height;let s=kr.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),n=kr}return n.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=Ko("canvas");t.width=e.width,t.height=e.height;let n=t.getContext("2d");n.drawImage(e,0,0,e.width,e.height);let s=n.getImageData(0,0,e.width,e.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=ms(r[o]/255)*255;return n.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let n=0;n<t.length;n++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[n]=Math.floor(ms(t[n]/255)*255):t[n]=ms(t[n]);return{data:t,width:e.width,height:e.height}}else return Je("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},y_=0,no=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:y_++}),this.uuid=dr(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(jh(s[o].image)):r.push(jh(s[o]))}else r=jh(s);n.url=r}return t||(e.images[this.uuid]=n),n}};function jh(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?Ll.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(Je("Texture: Unable to serialize Texture."),{})}var S_=0,Qh=new W,Yn=class i extends $i{constructor(e=i.DEFAULT_IMAGE,t=i.DEFAULT_MAPPING,n=Yi,s=Yi,r=dn,o=vs,a=ci,l=li,c=i.DEFAULT_ANISOTROPY,f=Ss){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:S_++}),this.uuid=dr(),this.name="",this.source=new no(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new xt(0,0),this.repeat=new xt(1,1),this.center=new xt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new nt,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=f,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(Qh).x}get height(){return this.source.getSize(Qh).y}get depth(){return this.source.getSize(Qh).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let n=e[t];if(n===void 0){Je(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Je(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),t||(e.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==Bu)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case Cl:e.x=e.x-Math.floor(e.x);break;case Yi:e.x=e.x<0?0:1;break;case Rl:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case Cl:e.y=e.y-Math.floor(e.y);break;case Yi:e.y=e.y<0?0:1;break;case Rl:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};Yn.DEFAULT_IMAGE=null;Yn.DEFAULT_MAPPING=Bu;Yn.DEFAULT_ANISOTROPY=1;var Lt=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,n=0,s=1){this.x=e,this.y=t,this.z=n,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,n,s){return this.x=e,this.y=t,this.z=n,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*t+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*t+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*t+o[7]*n+o[11]*s+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,n,s,r,l=e.elements,c=l[0],f=l[4],u=l[8],h=l[1],p=l[5],g=l[9],v=l[2],d=l[6],m=l[10];if(Math.abs(f-h)<.01&&Math.abs(u-v)<.01&&Math.abs(g-d)<.01){if(Math.abs(f+h)<.1&&Math.abs(u+v)<.1&&Math.abs(g+d)<.1&&Math.abs(c+p+m-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let T=(c+1)/2,S=(p+1)/2,C=(m+1)/2,E=(f+h)/4,_=(u+v)/4,b=(g+d)/4;return T>S&&T>C?T<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(T),s=E/n,r=_/n):S>C?S<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(S),n=E/s,r=b/s):C<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(C),n=_/r,s=b/r),this.set(n,s,r,t),this}let y=Math.sqrt((d-g)*(d-g)+(u-v)*(u-v)+(h-f)*(h-f));return Math.abs(y)<.001&&(y=1),this.x=(d-g)/y,this.y=(u-v)/y,this.z=(h-f)/y,this.w=Math.acos((c+p+m-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=yt(this.x,e.x,t.x),this.y=yt(this.y,e.y,t.y),this.z=yt(this.z,e.z,t.z),this.w=yt(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=yt(this.x,e,t),this.y=yt(this.y,e,t),this.z=yt(this.z,e,t),this.w=yt(this.w,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(yt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this.w=e.w+(t.w-e.w)*n,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Dl=class extends $i{constructor(e=1,t=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:dn,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=n.depth,this.scissor=new Lt(0,0,e,t),this.scissorTest=!1,this.viewport=new Lt(0,0,e,t),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new Yn({width:e,height:t,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:dn,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,n=1){if(this.width!==e||this.height!==t||this.depth!==n){this.width=e,this.height=t,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,n=e.textures.length;t<n;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new no(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},ri=class extends Dl{constructor(e=1,t=1,n={}){super(e,t,n),this.isWebGLRenderTarget=!0}},Qo=class extends Yn{constructor(e=null,t=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=fn,this.minFilter=fn,this.wrapR=Yi,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var io=class extends Yn{constructor(e=null,t=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=fn,this.minFilter=fn,this.wrapR=Yi,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var It=class i{static{this.prototype.isMatrix4=!0}constructor(e,t,n,s,r,o,a,l,c,f,u,h,p,g,v,d){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c,f,u,h,p,g,v,d)}set(e,t,n,s,r,o,a,l,c,f,u,h,p,g,v,d){let m=this.elements;return m[0]=e,m[4]=t,m[8]=n,m[12]=s,m[1]=r,m[5]=o,m[9]=a,m[13]=l,m[2]=c,m[6]=f,m[10]=u,m[14]=h,m[3]=p,m[7]=g,m[11]=v,m[15]=d,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new i().fromArray(this.elements)}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],t[9]=n[9],t[10]=n[10],t[11]=n[11],t[12]=n[12],t[13]=n[13],t[14]=n[14],t[15]=n[15],this}copyPosition(e){let t=this.elements,n=e.elements;return t[12]=n[12],t[13]=n[13],t[14]=n[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,n){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),n.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(e,t,n){return this.set(e.x,t.x,n.x,0,e.y,t.y,n.y,0,e.z,t.z,n.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,n=e.elements,s=1/Vr.setFromMatrixColumn(e,0).length(),r=1/Vr.setFromMatrixColumn(e,1).length(),o=1/Vr.setFromMatrixColumn(e,2).length();return t[0]=n[0]*s,t[1]=n[1]*s,t[2]=n[2]*s,t[3]=0,t[4]=n[4]*r,t[5]=n[5]*r,t[6]=n[6]*r,t[7]=0,t[8]=n[8]*o,t[9]=n[9]*o,t[10]=n[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,n=e.x,s=e.y,r=e.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),f=Math.cos(r),u=Math.sin(r);if(e.order==="XYZ"){let h=o*f,p=o*u,g=a*f,v=a*u;t[0]=l*f,t[4]=-l*u,t[8]=c,t[1]=p+g*c,t[5]=h-v*c,t[9]=-a*l,t[2]=v-h*c,t[6]=g+p*c,t[10]=o*l}else if(e.order==="YXZ"){let h=l*f,p=l*u,g=c*f,v=c*u;t[0]=h+v*a,t[4]=g*a-p,t[8]=o*c,t[1]=o*u,t[5]=o*f,t[9]=-a,t[2]=p*a-g,t[6]=v+h*a,t[10]=o*l}else if(e.order==="ZXY"){let h=l*f,p=l*u,g=c*f,v=c*u;t[0]=h-v*a,t[4]=-o*u,t[8]=g+p*a,t[1]=p+g*a,t[5]=o*f,t[9]=v-h*a,t[2]=-o*c,t[6]=a,t[10]=o*l}else if(e.order==="ZYX"){let h=o*f,p=o*u,g=a*f,v=a*u;t[0]=l*f,t[4]=g*c-p,t[8]=h*c+v,t[1]=l*u,t[5]=v*c+h,t[9]=p*c-g,t[2]=-c,t[6]=a*l,t[10]=o*l}else if(e.order==="YZX"){let h=o*l,p=o*c,g=a*l,v=a*c;t[0]=l*f,t[4]=v-h*u,t[8]=g*u+p,t[1]=u,t[5]=o*f,t[9]=-a*f,t[2]=-c*f,t[6]=p*u+g,t[10]=h-v*u}else if(e.order==="XZY"){let h=o*l,p=o*c,g=a*l,v=a*c;t[0]=l*f,t[4]=-u,t[8]=c*f,t[1]=h*u+v,t[5]=o*f,t[9]=p*u-g,t[2]=g*u-p,t[6]=a*f,t[10]=v*u+h}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(M_,e,b_)}lookAt(e,t,n){let s=this.elements;return ni.subVectors(e,t),ni.lengthSq()===0&&(ni.z=1),ni.normalize(),Is.crossVectors(n,ni),Is.lengthSq()===0&&(Math.abs(n.z)===1?ni.x+=1e-4:ni.z+=1e-4,ni.normalize(),Is.crossVectors(n,ni)),Is.normalize(),Za.crossVectors(ni,Is),s[0]=Is.x,s[4]=Za.x,s[8]=ni.x,s[1]=Is.y,s[5]=Za.y,s[9]=ni.y,s[2]=Is.z,s[6]=Za.z,s[10]=ni.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],f=n[1],u=n[5],h=n[9],p=n[13],g=n[2],v=n[6],d=n[10],m=n[14],y=n[3],T=n[7],S=n[11],C=n[15],E=s[0],_=s[4],b=s[8],U=s[12],D=s[1],P=s[5],z=s[9],V=s[13],L=s[2],H=s[6],Z=s[10],k=s[14],he=s[3],Y=s[7],Q=s[11],ne=s[15];return r[0]=o*E+a*D+l*L+c*he,r[4]=o*_+a*P+l*H+c*Y,r[8]=o*b+a*z+l*Z+c*Q,r[12]=o*U+a*V+l*k+c*ne,r[1]=f*E+u*D+h*L+p*he,r[5]=f*_+u*P+h*H+p*Y,r[9]=f*b+u*z+h*Z+p*Q,r[13]=f*U+u*V+h*k+p*ne,r[2]=g*E+v*D+d*L+m*he,r[6]=g*_+v*P+d*H+m*Y,r[10]=g*b+v*z+d*Z+m*Q,r[14]=g*U+v*V+d*k+m*ne,r[3]=y*E+T*D+S*L+C*he,r[7]=y*_+T*P+S*H+C*Y,r[11]=y*b+T*z+S*Z+C*Q,r[15]=y*U+T*V+S*k+C*ne,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[12],o=e[1],a=e[5],l=e[9],c=e[13],f=e[2],u=e[6],h=e[10],p=e[14],g=e[3],v=e[7],d=e[11],m=e[15],y=l*p-c*h,T=a*p-c*u,S=a*h-l*u,C=o*p-c*f,E=o*h-l*f,_=o*u-a*f;return t*(v*y-d*T+m*S)-n*(g*y-d*C+m*E)+s*(g*T-v*C+m*_)-r*(g*S-v*E+d*_)}determinantAffine(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[1],o=e[5],a=e[9],l=e[2],c=e[6],f=e[10];return t*(o*f-a*c)-n*(r*f-a*l)+s*(r*c-o*l)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,n){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=n),this}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],f=e[8],u=e[9],h=e[10],p=e[11],g=e[12],v=e[13],d=e[14],m=e[15],y=t*a-n*o,T=t*l-s*o,S=t*c-r*o,C=n*l-s*a,E=n*c-r*a,_=s*c-r*l,b=f*v-u*g,U=f*d-h*g,D=f*m-p*g,P=u*d-h*v,z=u*m-p*v,V=h*m-p*d,L=y*V-T*z+S*P+C*D-E*U+_*b;if(L===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let H=1/L;return e[0]=(a*V-l*z+c*P)*H,e[1]=(s*z-n*V-r*P)*H,e[2]=(v*_-d*E+m*C)*H,e[3]=(h*E-u*_-p*C)*H,e[4]=(l*D-o*V-c*U)*H,e[5]=(t*V-s*D+r*U)*H,e[6]=(d*S-g*_-m*T)*H,e[7]=(f*_-h*S+p*T)*H,e[8]=(o*z-a*D+c*b)*H,e[9]=(n*D-t*z-r*b)*H,e[10]=(g*E-v*S+m*y)*H,e[11]=(u*S-f*E-p*y)*H,e[12]=(a*U-o*P-l*b)*H,e[13]=(t*P-n*U+s*b)*H,e[14]=(v*T-g*C-d*y)*H,e[15]=(f*C-u*T+h*y)*H,this}scale(e){let t=this.elements,n=e.x,s=e.y,r=e.z;return t[0]*=n,t[4]*=s,t[8]*=r,t[1]*=n,t[5]*=s,t[9]*=r,t[2]*=n,t[6]*=s,t[10]*=r,t[3]*=n,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],n=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,n,s))}makeTranslation(e,t,n){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,n,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),n=Math.sin(e);return this.set(1,0,0,0,0,t,-n,0,0,n,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,0,n,0,0,1,0,0,-n,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,0,n,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let n=Math.cos(t),s=Math.sin(t),r=1-n,o=e.x,a=e.y,l=e.z,c=r*o,f=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,f*a+n,f*l-s*o,0,c*l-s*a,f*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(e,t,n){return this.set(e,0,0,0,0,t,0,0,0,0,n,0,0,0,0,1),this}makeShear(e,t,n,s,r,o){return this.set(1,n,r,0,e,1,o,0,t,s,1,0,0,0,0,1),this}compose(e,t,n){let s=this.elements,r=t._x,o=t._y,a=t._z,l=t._w,c=r+r,f=o+o,u=a+a,h=r*c,p=r*f,g=r*u,v=o*f,d=o*u,m=a*u,y=l*c,T=l*f,S=l*u,C=n.x,E=n.y,_=n.z;return s[0]=(1-(v+m))*C,s[1]=(p+S)*C,s[2]=(g-T)*C,s[3]=0,s[4]=(p-S)*E,s[5]=(1-(h+m))*E,s[6]=(d+y)*E,s[7]=0,s[8]=(g+T)*_,s[9]=(d-y)*_,s[10]=(1-(h+v))*_,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,n){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),t.identity(),this;let o=Vr.set(s[0],s[1],s[2]).length(),a=Vr.set(s[4],s[5],s[6]).length(),l=Vr.set(s[8],s[9],s[10]).length();r<0&&(o=-o),Ci.copy(this);let c=1/o,f=1/a,u=1/l;return Ci.elements[0]*=c,Ci.elements[1]*=c,Ci.elements[2]*=c,Ci.elements[4]*=f,Ci.elements[5]*=f,Ci.elements[6]*=f,Ci.elements[8]*=u,Ci.elements[9]*=u,Ci.elements[10]*=u,t.setFromRotationMatrix(Ci),n.x=o,n.y=a,n.z=l,this}makePerspective(e,t,n,s,r,o,a=xi,l=!1){let c=this.elements,f=2*r/(t-e),u=2*r/(n-s),h=(t+e)/(t-e),p=(n+s)/(n-s),g,v;if(l)g=r/(o-r),v=o*r/(o-r);else if(a===xi)g=-(o+r)/(o-r),v=-2*o*r/(o-r);else if(a===Jo)g=-o/(o-r),v=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=f,c[4]=0,c[8]=h,c[12]=0,c[1]=0,c[5]=u,c[9]=p,c[13]=0,c[2]=0,c[6]=0,c[10]=g,c[14]=v,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(e,t,n,s,r,o,a=xi,l=!1){let c=this.elements,f=2/(t-e),u=2/(n-s),h=-(t+e)/(t-e),p=-(n+s)/(n-s),g,v;if(l)g=1/(o-r),v=o/(o-r);else if(a===xi)g=-2/(o-r),v=-(o+r)/(o-r);else if(a===Jo)g=-1/(o-r),v=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=f,c[4]=0,c[8]=0,c[12]=h,c[1]=0,c[5]=u,c[9]=0,c[13]=p,c[2]=0,c[6]=0,c[10]=g,c[14]=v,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<16;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<16;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e[t+9]=n[9],e[t+10]=n[10],e[t+11]=n[11],e[t+12]=n[12],e[t+13]=n[13],e[t+14]=n[14],e[t+15]=n[15],e}},Vr=new W,Ci=new It,M_=new W(0,0,0),b_=new W(1,1,1),Is=new W,Za=new W,ni=new W,Hd=new It,Wd=new Zi,Os=class i{constructor(e=0,t=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=n,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,n,s=this._order){return this._x=e,this._y=t,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,n=!0){let s=e.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],f=s[9],u=s[2],h=s[6],p=s[10];switch(t){case"XYZ":this._y=Math.asin(yt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-f,p),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(h,c),this._z=0);break;case"YXZ":this._x=Math.asin(-yt(f,-1,1)),Math.abs(f)<.9999999?(this._y=Math.atan2(a,p),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(yt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(-u,p),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-yt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(h,p),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(yt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-f,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,p));break;case"XZY":this._z=Math.asin(-yt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(h,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-f,p),this._y=0);break;default:Je("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,n===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,n){return Hd.makeRotationFromQuaternion(e),this.setFromRotationMatrix(Hd,t,n)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return Wd.setFromEuler(this),this.setFromQuaternion(Wd,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};Os.DEFAULT_ORDER="XYZ";var so=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},w_=0,Xd=new W,Gr=new Zi,hs=new It,Ja=new W,Go=new W,A_=new W,T_=new Zi,qd=new W(1,0,0),Yd=new W(0,1,0),$d=new W(0,0,1),Zd={type:"added"},E_={type:"removed"},Hr={type:"childadded",child:null},eu={type:"childremoved",child:null},$n=class i extends $i{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:w_++}),this.uuid=dr(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let e=new W,t=new Os,n=new Zi,s=new W(1,1,1);function r(){n.setFromEuler(t,!1)}function o(){t.setFromQuaternion(n,void 0,!1)}t._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new It},normalMatrix:{value:new nt}}),this.matrix=new It,this.matrixWorld=new It,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new so,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return Gr.setFromAxisAngle(e,t),this.quaternion.multiply(Gr),this}rotateOnWorldAxis(e,t){return Gr.setFromAxisAngle(e,t),this.quaternion.premultiply(Gr),this}rotateX(e){return this.rotateOnAxis(qd,e)}rotateY(e){return this.rotateOnAxis(Yd,e)}rotateZ(e){return this.rotateOnAxis($d,e)}translateOnAxis(e,t){return Xd.copy(e).applyQuaternion(this.quaternion),this.position.add(Xd.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(qd,e)}translateY(e){return this.translateOnAxis(Yd,e)}translateZ(e){return this.translateOnAxis($d,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(hs.copy(this.matrixWorld).invert())}lookAt(e,t,n){e.isVector3?Ja.copy(e):Ja.set(e,t,n);let s=this.parent;this.updateWorldMatrix(!0,!1),Go.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?hs.lookAt(Go,Ja,this.up):hs.lookAt(Ja,Go,this.up),this.quaternion.setFromRotationMatrix(hs),s&&(hs.extractRotation(s.matrixWorld),Gr.setFromRotationMatrix(hs),this.quaternion.premultiply(Gr.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(et("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(Zd),Hr.child=e,this.dispatchEvent(Hr),Hr.child=null):et("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(E_),eu.child=e,this.dispatchEvent(eu),eu.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),hs.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),hs.multiply(e.parent.matrixWorld)),e.applyMatrix4(hs),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(Zd),Hr.child=e,this.dispatchEvent(Hr),Hr.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let n=0,s=this.children.length;n<s;n++){let o=this.children[n].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,n=[]){this[e]===t&&n.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(e,t,n);return n}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Go,e,A_),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Go,T_,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,n=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*n-r[8]*s,r[13]+=n-r[1]*t-r[5]*n-r[9]*s,r[14]+=s-r[2]*t-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].updateMatrixWorld(e)}updateWorldMatrix(e,t,n=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(e){let t=e===void 0||typeof e=="string",n={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(e)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,f=l.length;c<f;c++){let u=l[c];r(e.shapes,u)}else r(e.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(e.materials,this.material[l]));s.material=a}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(e.animations,l))}}if(t){let a=o(e.geometries),l=o(e.materials),c=o(e.textures),f=o(e.images),u=o(e.shapes),h=o(e.skeletons),p=o(e.animations),g=o(e.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),f.length>0&&(n.images=f),u.length>0&&(n.shapes=u),h.length>0&&(n.skeletons=h),p.length>0&&(n.animations=p),g.length>0&&(n.nodes=g)}return n.object=s,n;function o(a){let l=[];for(let c in a){let f=a[c];delete f.metadata,l.push(f)}return l}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let n=0;n<e.children.length;n++){let s=e.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};$n.DEFAULT_UP=new W(0,1,0);$n.DEFAULT_MATRIX_AUTO_UPDATE=!0;$n.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Li=class extends $n{constructor(){super(),this.isGroup=!0,this.type="Group"}},C_={type:"move"},ro=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Li,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Li,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new W,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new W),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Li,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new W,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new W,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let n of e.hand.values())this._getHandJoint(t,n)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,n){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(c&&e.hand){o=!0;for(let v of e.hand.values()){let d=t.getJointPose(v,n),m=this._getHandJoint(c,v);d!==null&&(m.matrix.fromArray(d.transform.matrix),m.matrix.decompose(m.position,m.quaternion,m.scale),m.matrixWorldNeedsUpdate=!0,m.jointRadius=d.radius),m.visible=d!==null}let f=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],h=f.position.distanceTo(u.position),p=.02,g=.005;c.inputState.pinching&&h>p+g?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!c.inputState.pinching&&h<=p-g&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else l!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(s=t.getPose(e.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(C_)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let n=new Li;n.matrixAutoUpdate=!1,n.visible=!1,e.joints[t.jointName]=n,e.add(n)}return e.joints[t.jointName]}},Qp={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Ls={h:0,s:0,l:0},Ka={h:0,s:0,l:0};function tu(i,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?i+(e-i)*6*t:t<1/2?e:t<2/3?i+(e-i)*6*(2/3-t):i}var ht=class{constructor(e,t,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,n)}set(e,t,n){if(t===void 0&&n===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,n);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=si){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,mt.colorSpaceToWorking(this,t),this}setRGB(e,t,n,s=mt.workingColorSpace){return this.r=e,this.g=t,this.b=n,mt.colorSpaceToWorking(this,s),this}setHSL(e,t,n,s=mt.workingColorSpace){if(e=x_(e,1),t=yt(t,0,1),n=yt(n,0,1),t===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+t):n+t-n*t,o=2*n-r;this.r=tu(o,r,e+1/3),this.g=tu(o,r,e),this.b=tu(o,r,e-1/3)}return mt.colorSpaceToWorking(this,s),this}setStyle(e,t=si){function n(r){r!==void 0&&parseFloat(r)<1&&Je("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:Je("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);Je("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=si){let n=Qp[e.toLowerCase()];return n!==void 0?this.setHex(n,t):Je("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=ms(e.r),this.g=ms(e.g),this.b=ms(e.b),this}copyLinearToSRGB(e){return this.r=Qr(e.r),this.g=Qr(e.g),this.b=Qr(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=si){return mt.workingToColorSpace(Fn.copy(this),e),Math.round(yt(Fn.r*255,0,255))*65536+Math.round(yt(Fn.g*255,0,255))*256+Math.round(yt(Fn.b*255,0,255))}getHexString(e=si){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=mt.workingColorSpace){mt.workingToColorSpace(Fn.copy(this),t);let n=Fn.r,s=Fn.g,r=Fn.b,o=Math.max(n,s,r),a=Math.min(n,s,r),l,c,f=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=f<=.5?u/(o+a):u/(2-o-a),o){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return e.h=l,e.s=c,e.l=f,e}getRGB(e,t=mt.workingColorSpace){return mt.workingToColorSpace(Fn.copy(this),t),e.r=Fn.r,e.g=Fn.g,e.b=Fn.b,e}getStyle(e=si){mt.workingToColorSpace(Fn.copy(this),e);let t=Fn.r,n=Fn.g,s=Fn.b;return e!==si?`color(${e} ${t.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(e,t,n){return this.getHSL(Ls),this.setHSL(Ls.h+e,Ls.s+t,Ls.l+n)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,n){return this.r=e.r+(t.r-e.r)*n,this.g=e.g+(t.g-e.g)*n,this.b=e.b+(t.b-e.b)*n,this}lerpHSL(e,t){this.getHSL(Ls),e.getHSL(Ka);let n=Zh(Ls.h,Ka.h,t),s=Zh(Ls.s,Ka.s,t),r=Zh(Ls.l,Ka.l,t);return this.setHSL(n,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,n=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*n+r[6]*s,this.g=r[1]*t+r[4]*n+r[7]*s,this.b=r[2]*t+r[5]*n+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},Fn=new ht;ht.NAMES=Qp;var sr=class extends $n{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Os,this.environmentIntensity=1,this.environmentRotation=new Os,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},Ri=new W,us=new W,nu=new W,fs=new W,Wr=new W,Xr=new W,Jd=new W,iu=new W,su=new W,ru=new W,ou=new Lt,au=new Lt,lu=new Lt,Fs=class i{constructor(e=new W,t=new W,n=new W){this.a=e,this.b=t,this.c=n}static getNormal(e,t,n,s){s.subVectors(n,t),Ri.subVectors(e,t),s.cross(Ri);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,n,s,r){Ri.subVectors(s,t),us.subVectors(n,t),nu.subVectors(e,t);let o=Ri.dot(Ri),a=Ri.dot(us),l=Ri.dot(nu),c=us.dot(us),f=us.dot(nu),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let h=1/u,p=(c*l-a*f)*h,g=(o*f-a*l)*h;return r.set(1-p-g,g,p)}static containsPoint(e,t,n,s){return this.getBarycoord(e,t,n,s,fs)===null?!1:fs.x>=0&&fs.y>=0&&fs.x+fs.y<=1}static getInterpolation(e,t,n,s,r,o,a,l){return this.getBarycoord(e,t,n,s,fs)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,fs.x),l.addScaledVector(o,fs.y),l.addScaledVector(a,fs.z),l)}static getInterpolatedAttribute(e,t,n,s,r,o){return ou.setScalar(0),au.setScalar(0),lu.setScalar(0),ou.fromBufferAttribute(e,t),au.fromBufferAttribute(e,n),lu.fromBufferAttribute(e,s),o.setScalar(0),o.addScaledVector(ou,r.x),o.addScaledVector(au,r.y),o.addScaledVector(lu,r.z),o}static isFrontFacing(e,t,n,s){return Ri.subVectors(n,t),us.subVectors(e,t),Ri.cross(us).dot(s)<0}set(e,t,n){return this.a.copy(e),this.b.copy(t),this.c.copy(n),this}setFromPointsAndIndices(e,t,n,s){return this.a.copy(e[t]),this.b.copy(e[n]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,n,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,n),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return Ri.subVectors(this.c,this.b),us.subVectors(this.a,this.b),Ri.cross(us).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return i.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return i.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,n,s,r){return i.getInterpolation(e,this.a,this.b,this.c,t,n,s,r)}containsPoint(e){return i.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return i.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let n=this.a,s=this.b,r=this.c,o,a;Wr.subVectors(s,n),Xr.subVectors(r,n),iu.subVectors(e,n);let l=Wr.dot(iu),c=Xr.dot(iu);if(l<=0&&c<=0)return t.copy(n);su.subVectors(e,s);let f=Wr.dot(su),u=Xr.dot(su);if(f>=0&&u<=f)return t.copy(s);let h=l*u-f*c;if(h<=0&&l>=0&&f<=0&&l-f>0)return o=l/(l-f),t.copy(n).addScaledVector(Wr,o);ru.subVectors(e,r);let p=Wr.dot(ru),g=Xr.dot(ru);if(g>=0&&p<=g)return t.copy(r);let v=p*c-l*g;if(v<=0&&c>=0&&g<=0)return a=c/(c-g),t.copy(n).addScaledVector(Xr,a);let d=f*g-p*u;if(d<=0&&u-f>=0&&p-g>=0)return Jd.subVectors(r,s),a=(u-f)/(u-f+(p-g)),t.copy(s).addScaledVector(Jd,a);let m=1/(d+v+h);return o=v*m,a=h*m,t.copy(n).addScaledVector(Wr,o).addScaledVector(Xr,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},Bs=class{constructor(e=new W(1/0,1/0,1/0),t=new W(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t+=3)this.expandByPoint(Pi.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,n=e.count;t<n;t++)this.expandByPoint(Pi.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let n=Pi.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(n),this.max.copy(e).add(n),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let n=e.geometry;if(n!==void 0){let r=n.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,Pi):Pi.fromBufferAttribute(r,o),Pi.applyMatrix4(e.matrixWorld),this.expandByPoint(Pi);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),ja.copy(e.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),ja.copy(n.boundingBox)),ja.applyMatrix4(e.matrixWorld),this.union(ja)}let s=e.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,Pi),Pi.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,n;return e.normal.x>0?(t=e.normal.x*this.min.x,n=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,n=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,n+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,n+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,n+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,n+=e.normal.z*this.min.z),t<=-e.constant&&n>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(Ho),Qa.subVectors(this.max,Ho),qr.subVectors(e.a,Ho),Yr.subVectors(e.b,Ho),$r.subVectors(e.c,Ho),Ds.subVectors(Yr,qr),Ns.subVectors($r,Yr),Qs.subVectors(qr,$r);let t=[0,-Ds.z,Ds.y,0,-Ns.z,Ns.y,0,-Qs.z,Qs.y,Ds.z,0,-Ds.x,Ns.z,0,-Ns.x,Qs.z,0,-Qs.x,-Ds.y,Ds.x,0,-Ns.y,Ns.x,0,-Qs.y,Qs.x,0];return!cu(t,qr,Yr,$r,Qa)||(t=[1,0,0,0,1,0,0,0,1],!cu(t,qr,Yr,$r,Qa))?!1:(el.crossVectors(Ds,Ns),t=[el.x,el.y,el.z],cu(t,qr,Yr,$r,Qa))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,Pi).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(Pi).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(ds[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),ds[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),ds[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),ds[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),ds[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),ds[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),ds[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),ds[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(ds),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},ds=[new W,new W,new W,new W,new W,new W,new W,new W],Pi=new W,ja=new Bs,qr=new W,Yr=new W,$r=new W,Ds=new W,Ns=new W,Qs=new W,Ho=new W,Qa=new W,el=new W,er=new W;function cu(i,e,t,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){er.fromArray(i,r);let a=s.x*Math.abs(er.x)+s.y*Math.abs(er.y)+s.z*Math.abs(er.z),l=e.dot(er),c=t.dot(er),f=n.dot(er);if(Math.max(-Math.max(l,c,f),Math.min(l,c,f))>a)return!1}return!0}var un=new W,tl=new xt,R_=0,Xt=class extends $i{constructor(e,t,n=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:R_++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=n,this.usage=ju,this.updateRanges=[],this.gpuType=Ni,this.version=0,this._normalizationScale=e!==void 0?Gc(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,n){e*=this.itemSize,n*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[n+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,n=this.count;t<n;t++)tl.fromBufferAttribute(this,t),tl.applyMatrix3(e),this.setXY(t,tl.x,tl.y);else if(this.itemSize===3)for(let t=0,n=this.count;t<n;t++)un.fromBufferAttribute(this,t),un.applyMatrix3(e),this.setXYZ(t,un.x,un.y,un.z);return this}applyMatrix4(e){for(let t=0,n=this.count;t<n;t++)un.fromBufferAttribute(this,t),un.applyMatrix4(e),this.setXYZ(t,un.x,un.y,un.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)un.fromBufferAttribute(this,t),un.applyNormalMatrix(e),this.setXYZ(t,un.x,un.y,un.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)un.fromBufferAttribute(this,t),un.transformDirection(e),this.setXYZ(t,un.x,un.y,un.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let n=this.array[e*this.itemSize+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.array[e*this.itemSize+t]=n,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,n){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.array[e+0]=t,this.array[e+1]=n,this}setXYZ(e,t,n,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):Kp(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):jp(e,this.array)}};var ea=class extends Xt{constructor(e,t,n){super(new Uint16Array(e),t,n)}};var ta=class extends Xt{constructor(e,t,n){super(new Uint32Array(e),t,n)}};var qn=class extends Xt{constructor(e,t,n){super(new Float32Array(e),t,n)}},P_=new Bs,Wo=new W,hu=new W,vi=class{constructor(e=new W,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let n=this.center;t!==void 0?n.copy(t):P_.setFromPoints(e).getCenter(n);let s=0;for(let r=0,o=e.length;r<o;r++)s=Math.max(s,n.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let n=this.center.distanceToSquared(e);return t.copy(e),n>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;Wo.subVectors(e,this.center);let t=Wo.lengthSq();if(t>this.radius*this.radius){let n=Math.sqrt(t),s=(n-this.radius)*.5;this.center.addScaledVector(Wo,s/n),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(hu.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(Wo.copy(e.center).add(hu)),this.expandByPoint(Wo.copy(e.center).sub(hu))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},I_=0,_i=new It,uu=new $n,Zr=new W,ii=new Bs,Xo=new Bs,Pn=new W,xn=class i extends $i{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:I_++}),this.uuid=dr(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(g_(e)?ta:ea)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,n=0){this.groups.push({start:e,count:t,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new nt().getNormalMatrix(e);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return _i.makeRotationFromQuaternion(e),this.applyMatrix4(_i),this}rotateX(e){return _i.makeRotationX(e),this.applyMatrix4(_i),this}rotateY(e){return _i.makeRotationY(e),this.applyMatrix4(_i),this}rotateZ(e){return _i.makeRotationZ(e),this.applyMatrix4(_i),this}translate(e,t,n){return _i.makeTranslation(e,t,n),this.applyMatrix4(_i),this}scale(e,t,n){return _i.makeScale(e,t,n),this.applyMatrix4(_i),this}lookAt(e){return uu.lookAt(e),uu.updateMatrix(),this.applyMatrix4(uu.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(Zr).negate(),this.translate(Zr.x,Zr.y,Zr.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let n=[];for(let s=0,r=e.length;s<r;s++){let o=e[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new qn(n,3))}else{let n=Math.min(e.length,t.count);for(let s=0;s<n;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&Je("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Bs);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){et("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new W(-1/0,-1/0,-1/0),new W(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let n=0,s=t.length;n<s;n++){let r=t[n];ii.setFromBufferAttribute(r),this.morphTargetsRelative?(Pn.addVectors(this.boundingBox.min,ii.min),this.boundingBox.expandByPoint(Pn),Pn.addVectors(this.boundingBox.max,ii.max),this.boundingBox.expandByPoint(Pn)):(this.boundingBox.expandByPoint(ii.min),this.boundingBox.expandByPoint(ii.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&et('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new vi);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){et("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new W,1/0);return}if(e){let n=this.boundingSphere.center;if(ii.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];Xo.setFromBufferAttribute(a),this.morphTargetsRelative?(Pn.addVectors(ii.min,Xo.min),ii.expandByPoint(Pn),Pn.addVectors(ii.max,Xo.max),ii.expandByPoint(Pn)):(ii.expandByPoint(Xo.min),ii.expandByPoint(Xo.max))}ii.getCenter(n);let s=0;for(let r=0,o=e.count;r<o;r++)Pn.fromBufferAttribute(e,r),s=Math.max(s,n.distanceToSquared(Pn));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],l=this.morphTargetsRelative;for(let c=0,f=a.count;c<f;c++)Pn.fromBufferAttribute(a,c),l&&(Zr.fromBufferAttribute(e,c),Pn.add(Zr)),s=Math.max(s,n.distanceToSquared(Pn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&et('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){et("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=t.position,s=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new Xt(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let U=0;U<n.count;U++)a[U]=new W,l[U]=new W;let f=new W,u=new W,h=new W,p=new xt,g=new xt,v=new xt,d=new W,m=new W;function y(U,D,P){c[U]=c[D]=c[P]=1,f.fromBufferAttribute(n,U),u.fromBufferAttribute(n,D),h.fromBufferAttribute(n,P),p.fromBufferAttribute(r,U),g.fromBufferAttribute(r,D),v.fromBufferAttribute(r,P),u.sub(f),h.sub(f),g.sub(p),v.sub(p);let z=1/(g.x*v.y-v.x*g.y);isFinite(z)&&(d.copy(u).multiplyScalar(v.y).addScaledVector(h,-g.y).multiplyScalar(z),m.copy(h).multiplyScalar(g.x).addScaledVector(u,-v.x).multiplyScalar(z),a[U].add(d),a[D].add(d),a[P].add(d),l[U].add(m),l[D].add(m),l[P].add(m))}let T=this.groups;T.length===0&&(T=[{start:0,count:e.count}]);for(let U=0,D=T.length;U<D;++U){let P=T[U],z=P.start,V=P.count;for(let L=z,H=z+V;L<H;L+=3)y(e.getX(L+0),e.getX(L+1),e.getX(L+2))}let S=new W,C=new W,E=new W,_=new W;function b(U){E.fromBufferAttribute(s,U),_.copy(E);let D=a[U];S.copy(D),S.sub(E.multiplyScalar(E.dot(D))).normalize(),C.crossVectors(_,D);let z=C.dot(l[U])<0?-1:1;o.setXYZW(U,S.x,S.y,S.z,z)}for(let U=0,D=n.count;U<D;++U)c[U]&&b(U);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==t.count)n=new Xt(new Float32Array(t.count*3),3),this.setAttribute("normal",n);else for(let h=0,p=n.count;h<p;h++)n.setXYZ(h,0,0,0);let s=new W,r=new W,o=new W,a=new W,l=new W,c=new W,f=new W,u=new W;if(e)for(let h=0,p=e.count;h<p;h+=3){let g=e.getX(h+0),v=e.getX(h+1),d=e.getX(h+2);s.fromBufferAttribute(t,g),r.fromBufferAttribute(t,v),o.fromBufferAttribute(t,d),f.subVectors(o,r),u.subVectors(s,r),f.cross(u),a.fromBufferAttribute(n,g),l.fromBufferAttribute(n,v),c.fromBufferAttribute(n,d),a.add(f),l.add(f),c.add(f),n.setXYZ(g,a.x,a.y,a.z),n.setXYZ(v,l.x,l.y,l.z),n.setXYZ(d,c.x,c.y,c.z)}else for(let h=0,p=t.count;h<p;h+=3)s.fromBufferAttribute(t,h+0),r.fromBufferAttribute(t,h+1),o.fromBufferAttribute(t,h+2),f.subVectors(o,r),u.subVectors(s,r),f.cross(u),n.setXYZ(h+0,f.x,f.y,f.z),n.setXYZ(h+1,f.x,f.y,f.z),n.setXYZ(h+2,f.x,f.y,f.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,n=e.count;t<n;t++)Pn.fromBufferAttribute(e,t),Pn.normalize(),e.setXYZ(t,Pn.x,Pn.y,Pn.z)}toNonIndexed(){function e(a,l){let c=a.array,f=a.itemSize,u=a.normalized,h=new c.constructor(l.length*f),p=0,g=0;for(let v=0,d=l.length;v<d;v++){a.isInterleavedBufferAttribute?p=l[v]*a.data.stride+a.offset:p=l[v]*f;for(let m=0;m<f;m++)h[g++]=c[p++]}return new Xt(h,f,u)}if(this.index===null)return Je("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new i,n=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=e(l,n);t.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let f=0,u=c.length;f<u;f++){let h=c[f],p=e(h,n);l.push(p)}t.morphAttributes[a]=l}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];t.addGroup(c.start,c.count,c.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(e[c]=l[c]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let n=this.attributes;for(let l in n){let c=n[l];e.data.attributes[l]=c.toJSON(e.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],f=[];for(let u=0,h=c.length;u<h;u++){let p=c[u];f.push(p.toJSON(e.data))}f.length>0&&(s[l]=f,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let n=e.index;n!==null&&this.setIndex(n.clone());let s=e.attributes;for(let c in s){let f=s[c];this.setAttribute(c,f.clone(t))}let r=e.morphAttributes;for(let c in r){let f=[],u=r[c];for(let h=0,p=u.length;h<p;h++)f.push(u[h].clone(t));this.morphAttributes[c]=f}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let c=0,f=o.length;c<f;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=e.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},Nl=class{constructor(e,t){this.isInterleavedBuffer=!0,this.array=e,this.stride=t,this.count=e!==void 0?e.length/t:0,this.usage=ju,this.updateRanges=[],this.version=0,this.uuid=dr()}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.array=new e.array.constructor(e.array),this.count=e.count,this.stride=e.stride,this.usage=e.usage,this}copyAt(e,t,n){e*=this.stride,n*=t.stride;for(let s=0,r=this.stride;s<r;s++)this.array[e+s]=t.array[n+s];return this}set(e,t=0){return this.array.set(e,t),this}clone(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=Kd(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=this.array.slice(0).buffer);let n=new this.array.constructor(e.arrayBuffers[t]),s=new this.constructor(n,this.stride);return s.setUsage(this.usage),s}onUpload(e){return this.onUploadCallback=e,this}toJSON(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=Kd(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let n={uuid:this.uuid,buffer:t,type:this.array.constructor.name,stride:this.stride};return n.usage=this.usage,n}};function Kd(i){return i.buffer._uuid===void 0&&(i.buffer._uuid=dr()),i.byteOffset===0&&i.byteLength===i.buffer.byteLength?i.buffer._uuid:i.buffer._uuid+":"+i.byteOffset+":"+i.byteLength}var Wn=new W,rr=class i{constructor(e,t,n,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=e,this.itemSize=t,this.offset=n,this.normalized=s,this._normalizationScale=e!==void 0?Gc(e.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(e){this.data.needsUpdate=e}applyMatrix4(e){for(let t=0,n=this.data.count;t<n;t++)Wn.fromBufferAttribute(this,t),Wn.applyMatrix4(e),this.setXYZ(t,Wn.x,Wn.y,Wn.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)Wn.fromBufferAttribute(this,t),Wn.applyNormalMatrix(e),this.setXYZ(t,Wn.x,Wn.y,Wn.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)Wn.fromBufferAttribute(this,t),Wn.transformDirection(e),this.setXYZ(t,Wn.x,Wn.y,Wn.z);return this}getComponent(e,t){let n=this.array[e*this.data.stride+this.offset+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.data.array[e*this.data.stride+this.offset+t]=n,this}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset]=t,this}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+1]=t,this}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+2]=t,this}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+3]=t,this}getX(e){let t=this.data.array[e*this.data.stride+this.offset];return this.normalized&&(t=this._denormalize(t)),t}getY(e){let t=this.data.array[e*this.data.stride+this.offset+1];return this.normalized&&(t=this._denormalize(t)),t}getZ(e){let t=this.data.array[e*this.data.stride+this.offset+2];return this.normalized&&(t=this._denormalize(t)),t}getW(e){let t=this.data.array[e*this.data.stride+this.offset+3];return this.normalized&&(t=this._denormalize(t)),t}setXY(e,t,n){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.data.array[e+0]=t,this.data.array[e+1]=n,this}setXYZ(e,t,n,s){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.data.array[e+0]=t,this.data.array[e+1]=n,this.data.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.data.array[e+0]=t,this.data.array[e+1]=n,this.data.array[e+2]=s,this.data.array[e+3]=r,this}clone(e){if(e===void 0){jo("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let n=0;n<this.count;n++){let s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return new Xt(new this.array.constructor(t),this.itemSize,this.normalized)}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.clone(e)),new i(e.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(e){if(e===void 0){jo("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let n=0;n<this.count;n++){let s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:t,normalized:this.normalized}}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.toJSON(e)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):Kp(e,this.data.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):jp(e,this.data.array)}},fu=new W,L_=new W,D_=new nt,Ii=class{constructor(e=new W(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,n,s){return this.normal.set(e,t,n),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,n){let s=fu.subVectors(n,t).cross(L_.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,n=!0){let s=e.delta(fu),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(s,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),n=this.distanceToPoint(e.end);return t<0&&n>0||n<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let n=t||D_.getNormalMatrix(e),s=this.coplanarPoint(fu).applyMatrix4(e),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},N_=0,_s=class extends $i{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:N_++}),this.uuid=dr(),this.name="",this.type="Material",this.blending=ho,this.side=yi,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Cu,this.blendDst=Ru,this.blendEquation=hr,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new ht(0,0,0),this.blendAlpha=0,this.depthFunc=eo,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Vc,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=yl,this.stencilZFail=yl,this.stencilZPass=yl,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let n=e[t];if(n===void 0){Je(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Je(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(e).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(e).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(e).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(e).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(e).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(t){let r=s(e.textures),o=s(e.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new ht().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(n=>new Ii().fromJSON(n))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let n=e.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new xt().fromArray(n)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new xt().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,n=null;if(t!==null){let s=t.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=t[r].clone()}return this.clippingPlanes=n,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}};var ps=new W,du=new W,nl=new W,il=new W,or=class{constructor(e=new W,t=new W(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,ps)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let n=t.dot(this.direction);return n<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=ps.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(ps.copy(this.origin).addScaledVector(this.direction,t),ps.distanceToSquared(e))}distanceSqToSegment(e,t,n,s){du.copy(e).add(t).multiplyScalar(.5),nl.copy(t).sub(e).normalize(),il.copy(this.origin).sub(du);let r=e.distanceTo(t)*.5,o=-this.direction.dot(nl),a=il.dot(this.direction),l=-il.dot(nl),c=il.lengthSq(),f=Math.abs(1-o*o),u,h,p,g;if(f>0)if(u=o*l-a,h=o*a-l,g=r*f,u>=0)if(h>=-g)if(h<=g){let v=1/f;u*=v,h*=v,p=u*(u+o*h+2*a)+h*(o*u+h+2*l)+c}else h=r,u=Math.max(0,-(o*h+a)),p=-u*u+h*(h+2*l)+c;else h=-r,u=Math.max(0,-(o*h+a)),p=-u*u+h*(h+2*l)+c;else h<=-g?(u=Math.max(0,-(-o*r+a)),h=u>0?-r:Math.min(Math.max(-r,-l),r),p=-u*u+h*(h+2*l)+c):h<=g?(u=0,h=Math.min(Math.max(-r,-l),r),p=h*(h+2*l)+c):(u=Math.max(0,-(o*r+a)),h=u>0?r:Math.min(Math.max(-r,-l),r),p=-u*u+h*(h+2*l)+c);else h=o>0?-r:r,u=Math.max(0,-(o*h+a)),p=-u*u+h*(h+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(du).addScaledVector(nl,h),p}intersectSphere(e,t){if(e.radius<0)return null;ps.subVectors(e.center,this.origin);let n=ps.dot(this.direction),s=ps.dot(ps)-n*n,r=e.radius*e.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(e.normal)+e.constant)/t;return n>=0?n:null}intersectPlane(e,t){let n=this.distanceToPlane(e);return n===null?null:this.at(n,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let n,s,r,o,a,l,c=1/this.direction.x,f=1/this.direction.y,u=1/this.direction.z,h=this.origin;return c>=0?(n=(e.min.x-h.x)*c,s=(e.max.x-h.x)*c):(n=(e.max.x-h.x)*c,s=(e.min.x-h.x)*c),f>=0?(r=(e.min.y-h.y)*f,o=(e.max.y-h.y)*f):(r=(e.max.y-h.y)*f,o=(e.min.y-h.y)*f),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(e.min.z-h.z)*u,l=(e.max.z-h.z)*u):(a=(e.max.z-h.z)*u,l=(e.min.z-h.z)*u),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,t)}intersectsBox(e){return this.intersectBox(e,ps)!==null}intersectTriangle(e,t,n,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,f=a.z,u=e.x-o.x,h=e.y-o.y,p=e.z-o.z,g=t.x-o.x,v=t.y-o.y,d=t.z-o.z,m=n.x-o.x,y=n.y-o.y,T=n.z-o.z,S=Math.abs(l),C=Math.abs(c),E=Math.abs(f),_,b,U,D,P,z,V,L,H,Z,k,he;if(S>=C&&S>=E?(U=l,z=u,H=g,he=m,l>=0?(_=c,b=f,D=h,P=p,V=v,L=d,Z=y,k=T):(_=f,b=c,D=p,P=h,V=d,L=v,Z=T,k=y)):C>=E?(U=c,z=h,H=v,he=y,c>=0?(_=f,b=l,D=p,P=u,V=d,L=g,Z=T,k=m):(_=l,b=f,D=u,P=p,V=g,L=d,Z=m,k=T)):(U=f,z=p,H=d,he=T,f>=0?(_=l,b=c,D=u,P=h,V=g,L=v,Z=m,k=y):(_=c,b=l,D=h,P=u,V=v,L=g,Z=y,k=m)),U===0)return null;let Y=_/U,Q=b/U,ne=1/U,de=D-Y*z,pe=P-Q*z,ee=V-Y*H,_e=L-Q*H,ye=Z-Y*he,Re=k-Q*he,we=ye*_e-Re*ee,qe=de*Re-pe*ye,rt=ee*pe-_e*de;if(s){if(we<0||qe<0||rt<0)return null}else if((we<0||qe<0||rt<0)&&(we>0||qe>0||rt>0))return null;let We=we+qe+rt;if(We===0)return null;let ft=ne*(we*z+qe*H+rt*he);return(We>0?ft<0:ft>0)?null:this.at(ft/We,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Ul=class extends _s{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new ht(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Os,this.combine=Pu,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},jd=new It,tr=new or,sl=new vi,Qd=new W,rl=new W,ol=new W,al=new W,pu=new W,ll=new W,ep=new W,cl=new W,vn=class extends $n{constructor(e=new xn,t=new Ul){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;t.fromBufferAttribute(s,e);let a=this.morphTargetInfluences;if(r&&a){ll.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let f=a[l],u=r[l];f!==0&&(pu.fromBufferAttribute(u,e),o?ll.addScaledVector(pu,f):ll.addScaledVector(pu.sub(t),f))}t.add(ll)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),sl.copy(n.boundingSphere),sl.applyMatrix4(r),tr.copy(e.ray).recast(e.near),!(sl.containsPoint(tr.origin)===!1&&(tr.intersectSphere(sl,Qd)===null||tr.origin.distanceToSquared(Qd)>(e.far-e.near)**2))&&(jd.copy(r).invert(),tr.copy(e.ray).applyMatrix4(jd),!(n.boundingBox!==null&&tr.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(e,t,tr)))}_computeIntersections(e,t,n){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,f=r.attributes.uv1,u=r.attributes.normal,h=r.groups,p=r.drawRange;if(a!==null)if(Array.isArray(o))for(let g=0,v=h.length;g<v;g++){let d=h[g],m=o[d.materialIndex],y=Math.max(d.start,p.start),T=Math.min(a.count,Math.min(d.start+d.count,p.start+p.count));for(let S=y,C=T;S<C;S+=3){let E=a.getX(S),_=a.getX(S+1),b=a.getX(S+2);s=hl(this,m,e,n,c,f,u,E,_,b),s&&(s.faceIndex=Math.floor(S/3),s.face.materialIndex=d.materialIndex,t.push(s))}}else{let g=Math.max(0,p.start),v=Math.min(a.count,p.start+p.count);for(let d=g,m=v;d<m;d+=3){let y=a.getX(d),T=a.getX(d+1),S=a.getX(d+2);s=hl(this,o,e,n,c,f,u,y,T,S),s&&(s.faceIndex=Math.floor(d/3),t.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let g=0,v=h.length;g<v;g++){let d=h[g],m=o[d.materialIndex],y=Math.max(d.start,p.start),T=Math.min(l.count,Math.min(d.start+d.count,p.start+p.count));for(let S=y,C=T;S<C;S+=3){let E=S,_=S+1,b=S+2;s=hl(this,m,e,n,c,f,u,E,_,b),s&&(s.faceIndex=Math.floor(S/3),s.face.materialIndex=d.materialIndex,t.push(s))}}else{let g=Math.max(0,p.start),v=Math.min(l.count,p.start+p.count);for(let d=g,m=v;d<m;d+=3){let y=d,T=d+1,S=d+2;s=hl(this,o,e,n,c,f,u,y,T,S),s&&(s.faceIndex=Math.floor(d/3),t.push(s))}}}};function U_(i,e,t,n,s,r,o,a){let l;if(e.side===pn?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,e.side===yi,a),l===null)return null;cl.copy(a),cl.applyMatrix4(i.matrixWorld);let c=t.ray.origin.distanceTo(cl);return c<t.near||c>t.far?null:{distance:c,point:cl.clone(),object:i}}function hl(i,e,t,n,s,r,o,a,l,c){i.getVertexPosition(a,rl),i.getVertexPosition(l,ol),i.getVertexPosition(c,al);let f=U_(i,e,t,n,rl,ol,al,ep);if(f){let u=new W;Fs.getBarycoord(ep,rl,ol,al,u),s&&(f.uv=Fs.getInterpolatedAttribute(s,a,l,c,u,new xt)),r&&(f.uv1=Fs.getInterpolatedAttribute(r,a,l,c,u,new xt)),o&&(f.normal=Fs.getInterpolatedAttribute(o,a,l,c,u,new W),f.normal.dot(n.direction)>0&&f.normal.multiplyScalar(-1));let h={a,b:l,c,normal:new W,materialIndex:0};Fs.getNormal(rl,ol,al,h.normal),f.face=h,f.barycoord=u}return f}var oo=class extends Yn{constructor(e=null,t=1,n=1,s,r,o,a,l,c=fn,f=fn,u,h){super(null,o,a,l,c,f,s,r,u,h),this.isDataTexture=!0,this.image={data:e,width:t,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var na=class extends Xt{constructor(e,t,n,s=1){super(e,t,n),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=s}copy(e){return super.copy(e),this.meshPerAttribute=e.meshPerAttribute,this}toJSON(){let e=super.toJSON();return e.meshPerAttribute=this.meshPerAttribute,e.isInstancedBufferAttribute=!0,e}};var nr=new vi,F_=new xt(.5,.5),ul=new W,ar=class{constructor(e=new Ii,t=new Ii,n=new Ii,s=new Ii,r=new Ii,o=new Ii){this.planes=[e,t,n,s,r,o]}set(e,t,n,s,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let n=0;n<6;n++)t[n].copy(e.planes[n]);return this}setFromProjectionMatrix(e,t=xi,n=!1){let s=this.planes,r=e.elements,o=r[0],a=r[1],l=r[2],c=r[3],f=r[4],u=r[5],h=r[6],p=r[7],g=r[8],v=r[9],d=r[10],m=r[11],y=r[12],T=r[13],S=r[14],C=r[15];if(s[0].setComponents(c-o,p-f,m-g,C-y).normalize(),s[1].setComponents(c+o,p+f,m+g,C+y).normalize(),s[2].setComponents(c+a,p+u,m+v,C+T).normalize(),s[3].setComponents(c-a,p-u,m-v,C-T).normalize(),n)s[4].setComponents(l,h,d,S).normalize(),s[5].setComponents(c-l,p-h,m-d,C-S).normalize();else if(s[4].setComponents(c-l,p-h,m-d,C-S).normalize(),t===xi)s[5].setComponents(c+l,p+h,m+d,C+S).normalize();else if(t===Jo)s[5].setComponents(l,h,d,S).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),nr.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),nr.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(nr)}intersectsSprite(e){nr.center.set(0,0,0);let t=F_.distanceTo(e.center);return nr.radius=.7071067811865476+t,nr.applyMatrix4(e.matrixWorld),this.intersectsSphere(nr)}intersectsSphere(e){let t=this.planes,n=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let n=0;n<6;n++){let s=t[n];if(ul.x=s.normal.x>0?e.max.x:e.min.x,ul.y=s.normal.y>0?e.max.y:e.min.y,ul.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(ul)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let n=0;n<6;n++)if(t[n].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},tp=new It,Fl=class i{constructor(){this.coordinateSystem=xi,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,n=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];tp.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new ar),n[s].setFromProjectionMatrix(tp,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,n=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new ar),t[s].copy(n[s]);return this._count=e._count,this}clone(){return new i().copy(this)}};var Ol=class extends _s{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new ht(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},Bl=new W,zl=new W,np=new It,qo=new or,fl=new vi,mu=new W,ip=new W,kl=class extends $n{constructor(e=new xn,t=new Ol){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[0];for(let s=1,r=t.count;s<r;s++)Bl.fromBufferAttribute(t,s-1),zl.fromBufferAttribute(t,s),n[s]=n[s-1],n[s]+=Bl.distanceTo(zl);e.setAttribute("lineDistance",new qn(n,1))}else Je("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.matrixWorld,r=e.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),fl.copy(n.boundingSphere),fl.applyMatrix4(s),fl.radius+=r,e.ray.intersectsSphere(fl)===!1)return;np.copy(s).invert(),qo.copy(e.ray).applyMatrix4(np);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,f=n.index,h=n.attributes.position;if(f!==null){let p=Math.max(0,o.start),g=Math.min(f.count,o.start+o.count);for(let v=p,d=g-1;v<d;v+=c){let m=f.getX(v),y=f.getX(v+1),T=dl(this,e,qo,l,m,y,v);T&&t.push(T)}if(this.isLineLoop){let v=f.getX(g-1),d=f.getX(p),m=dl(this,e,qo,l,v,d,g-1);m&&t.push(m)}}else{let p=Math.max(0,o.start),g=Math.min(h.count,o.start+o.count);for(let v=p,d=g-1;v<d;v+=c){let m=dl(this,e,qo,l,v,v+1,v);m&&t.push(m)}if(this.isLineLoop){let v=dl(this,e,qo,l,g-1,p,g-1);v&&t.push(v)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function dl(i,e,t,n,s,r,o){let a=i.geometry.attributes.position;if(Bl.fromBufferAttribute(a,s),zl.fromBufferAttribute(a,r),t.distanceSqToSegment(Bl,zl,mu,ip)>n)return;mu.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(mu);if(!(c<e.near||c>e.far))return{distance:c,point:ip.clone().applyMatrix4(i.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:i}}var sp=new W,rp=new W,lr=class extends kl{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[];for(let s=0,r=t.count;s<r;s+=2)sp.fromBufferAttribute(t,s),rp.fromBufferAttribute(t,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+sp.distanceTo(rp);e.setAttribute("lineDistance",new qn(n,1))}else Je("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var Vl=class extends _s{constructor(e){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new ht(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.size=e.size,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},op=new It,yu=new or,pl=new vi,ml=new W,ia=class extends $n{constructor(e=new xn,t=new Vl){super(),this.isPoints=!0,this.type="Points",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.matrixWorld,r=e.params.Points.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),pl.copy(n.boundingSphere),pl.applyMatrix4(s),pl.radius+=r,e.ray.intersectsSphere(pl)===!1)return;op.copy(s).invert(),yu.copy(e.ray).applyMatrix4(op);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=n.index,u=n.attributes.position;if(c!==null){let h=Math.max(0,o.start),p=Math.min(c.count,o.start+o.count);for(let g=h,v=p;g<v;g++){let d=c.getX(g);ml.fromBufferAttribute(u,d),ap(ml,d,l,s,e,t,this)}}else{let h=Math.max(0,o.start),p=Math.min(u.count,o.start+o.count);for(let g=h,v=p;g<v;g++)ml.fromBufferAttribute(u,g),ap(ml,g,l,s,e,t,this)}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function ap(i,e,t,n,s,r,o){let a=yu.distanceSqToPoint(i);if(a<t){let l=new W;yu.closestPointToPoint(i,l),l.applyMatrix4(n);let c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:e,face:null,faceIndex:null,barycoord:null,object:o})}}var sa=class extends Yn{constructor(e=[],t=ur,n,s,r,o,a,l,c,f){super(e,t,n,s,r,o,a,l,c,f),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}};var xs=class extends Yn{constructor(e,t,n=Di,s,r,o,a=fn,l=fn,c,f=gs,u=1){if(f!==gs&&f!==ys)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let h={width:e,height:t,depth:u};super(h,s,r,o,a,l,f,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new no(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},ra=class extends xs{constructor(e,t=Di,n=ur,s,r,o=fn,a=fn,l,c=gs){let f={width:e,height:e,depth:1},u=[f,f,f,f,f,f];super(e,e,t,n,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},oa=class extends Yn{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},ao=class i extends xn{constructor(e=1,t=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],f=[],u=[],h=0,p=0;g("z","y","x",-1,-1,n,t,e,o,r,0),g("z","y","x",1,-1,n,t,-e,o,r,1),g("x","z","y",1,1,e,n,t,s,o,2),g("x","z","y",1,-1,e,n,-t,s,o,3),g("x","y","z",1,-1,e,t,n,s,r,4),g("x","y","z",-1,-1,e,t,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new qn(c,3)),this.setAttribute("normal",new qn(f,3)),this.setAttribute("uv",new qn(u,2));function g(v,d,m,y,T,S,C,E,_,b,U){let D=S/_,P=C/b,z=S/2,V=C/2,L=E/2,H=_+1,Z=b+1,k=0,he=0,Y=new W;for(let Q=0;Q<Z;Q++){let ne=Q*P-V;for(let de=0;de<H;de++){let pe=de*D-z;Y[v]=pe*y,Y[d]=ne*T,Y[m]=L,c.push(Y.x,Y.y,Y.z),Y[v]=0,Y[d]=0,Y[m]=E>0?1:-1,f.push(Y.x,Y.y,Y.z),u.push(de/_),u.push(1-Q/b),k+=1}}for(let Q=0;Q<b;Q++)for(let ne=0;ne<_;ne++){let de=h+ne+H*Q,pe=h+ne+H*(Q+1),ee=h+(ne+1)+H*(Q+1),_e=h+(ne+1)+H*Q;l.push(de,pe,_e),l.push(pe,ee,_e),he+=6}a.addGroup(p,he,U),p+=he,h+=k}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}};var aa=class i extends xn{constructor(e=1,t=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:n,heightSegments:s};let r=e/2,o=t/2,a=Math.floor(n),l=Math.floor(s),c=a+1,f=l+1,u=e/a,h=t/l,p=[],g=[],v=[],d=[];for(let m=0;m<f;m++){let y=m*h-o;for(let T=0;T<c;T++){let S=T*u-r;g.push(S,-y,0),v.push(0,0,1),d.push(T/a),d.push(1-m/l)}}for(let m=0;m<l;m++)for(let y=0;y<a;y++){let T=y+c*m,S=y+c*(m+1),C=y+1+c*(m+1),E=y+1+c*m;p.push(T,S,E),p.push(S,C,E)}this.setIndex(p),this.setAttribute("position",new qn(g,3)),this.setAttribute("normal",new qn(v,3)),this.setAttribute("uv",new qn(d,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.widthSegments,e.heightSegments)}};function pr(i){let e={};for(let t in i){e[t]={};for(let n in i[t]){let s=i[t][n];if(lp(s))s.isRenderTargetTexture?(Je("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][n]=null):e[t][n]=s.clone();else if(Array.isArray(s))if(lp(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();e[t][n]=r}else e[t][n]=s.slice();else e[t][n]=s}}return e}function On(i){let e={};for(let t=0;t<i.length;t++){let n=pr(i[t]);for(let s in n)e[s]=n[s]}return e}function lp(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function O_(i){let e=[];for(let t=0;t<i.length;t++)e.push(i[t].clone());return e}function ef(i){let e=i.getRenderTarget();return e===null?i.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:mt.workingColorSpace}var em={clone:pr,merge:On},B_=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,z_=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Ji=class extends _s{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=B_,this.fragmentShader=z_,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=pr(e.uniforms),this.uniformsGroups=O_(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?t.uniforms[s]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[s]={type:"m4",value:o.toArray()}:t.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(t.extensions=n),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let n in e.uniforms){let s=e.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=t[s.value]||null;break;case"c":this.uniforms[n].value=new ht().setHex(s.value);break;case"v2":this.uniforms[n].value=new xt().fromArray(s.value);break;case"v3":this.uniforms[n].value=new W().fromArray(s.value);break;case"v4":this.uniforms[n].value=new Lt().fromArray(s.value);break;case"m3":this.uniforms[n].value=new nt().fromArray(s.value);break;case"m4":this.uniforms[n].value=new It().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let n in e.extensions)this.extensions[n]=e.extensions[n];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},oi=class extends Ji{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var Gl=class extends _s{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=zp,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},Hl=class extends _s{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function Jr(i,e){return!i||i.constructor===e?i:typeof e.BYTES_PER_ELEMENT=="number"?new e(i):Array.prototype.slice.call(i)}function gl(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var zs=class{constructor(e,t,n,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(n),this.sampleValues=t,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,n=this._cachedIndex,s=t[n],r=t[n-1];n:{e:{let o;t:{i:if(!(e<s)){for(let a=n+2;;){if(s===void 0){if(e<r)break i;return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=s,s=t[++n],e<s)break e}o=t.length;break t}if(!(e>=r)){let a=t[1];e<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=t[--n-1],e>=r)break e}o=n,n=0;break t}break n}for(;n<o;){let a=n+o>>>1;e<t[a]?o=a:n=a+1}if(s=t[n],r=t[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=e*s;for(let o=0;o!==s;++o)t[o]=n[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},Wl=class extends zs{constructor(e,t,n,s){super(e,t,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:_u,endingEnd:_u}}intervalChanged_(e,t,n){let s=this.parameterPositions,r=e-2,o=e+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case xu:r=e,a=2*t-n;break;case vu:r=s.length-2,a=t+s[r]-s[r+1];break;default:r=e,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case xu:o=e,l=2*n-t;break;case vu:o=1,l=n+s[1]-s[0];break;default:o=e-1,l=t}let c=(n-t)*.5,f=this.valueSize;this._weightPrev=c/(t-a),this._weightNext=c/(l-n),this._offsetPrev=r*f,this._offsetNext=o*f}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,f=this._offsetPrev,u=this._offsetNext,h=this._weightPrev,p=this._weightNext,g=(n-t)/(s-t),v=g*g,d=v*g,m=-h*d+2*h*v-h*g,y=(1+h)*d+(-1.5-2*h)*v+(-.5+h)*g+1,T=(-1-p)*d+(1.5+p)*v+.5*g,S=p*d-p*v;for(let C=0;C!==a;++C)r[C]=m*o[f+C]+y*o[c+C]+T*o[l+C]+S*o[u+C];return r}},Xl=class extends zs{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,f=(n-t)/(s-t),u=1-f;for(let h=0;h!==a;++h)r[h]=o[c+h]*u+o[l+h]*f;return r}},ql=class extends zs{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e){return this.copySampleValue_(e-1)}},Yl=class extends zs{interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,f=this.inTangents,u=this.outTangents;if(!f||!u){let g=(n-t)/(s-t),v=1-g;for(let d=0;d!==a;++d)r[d]=o[c+d]*v+o[l+d]*g;return r}let h=a*2,p=e-1;for(let g=0;g!==a;++g){let v=o[c+g],d=o[l+g],m=p*h+g*2,y=u[m],T=u[m+1],S=e*h+g*2,C=f[S],E=f[S+1],_=V_(n,t,y,C,s);r[g]=tm(_,v,T,E,d)}return r}};function tm(i,e,t,n,s){let r=1-i;return r*r*r*e+3*r*r*i*t+3*r*i*i*n+i*i*i*s}function k_(i,e,t,n,s){let r=1-i;return 3*r*r*(t-e)+6*r*i*(n-t)+3*i*i*(s-n)}function V_(i,e,t,n,s){let r=(i-e)/(s-e);for(let o=0;o<8;o++){let a=tm(r,e,t,n,s)-i;if(Math.abs(a)<1e-10)break;let l=k_(r,e,t,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var ai=class{constructor(e,t,n,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=Jr(t,this.TimeBufferType),this.values=Jr(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,n;if(t.toJSON!==this.toJSON)n=t.toJSON(e);else{n={name:e.name,times:Jr(e.times,Array),values:Jr(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(n.interpolation=s),gl(e.settings)&&(n.settings={inTangents:Jr(e.settings.inTangents,Array),outTangents:Jr(e.settings.outTangents,Array)})}return n.type=e.ValueTypeName,n}InterpolantFactoryMethodDiscrete(e){return new ql(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new Xl(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new Wl(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new Yl(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case $o:t=this.InterpolantFactoryMethodDiscrete;break;case Pl:t=this.InterpolantFactoryMethodLinear;break;case vl:t=this.InterpolantFactoryMethodSmooth;break;case gu:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return Je("KeyframeTrack:",n),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return $o;case this.InterpolantFactoryMethodLinear:return Pl;case this.InterpolantFactoryMethodSmooth:return vl;case this.InterpolantFactoryMethodBezier:return gu}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]+=e;gl(this.settings)&&(cp(this.settings.inTangents,e),cp(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]*=e;gl(this.settings)&&(hp(this.settings.inTangents,e),hp(this.settings.outTangents,e))}return this}trim(e,t){let n=this.times,s=n.length,r=0,o=s-1;for(;r!==s&&n[r]<e;)++r;for(;o!==-1&&n[o]>t;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(et("KeyframeTrack: Invalid value size in track.",this),e=!1);let n=this.times,s=this.values,r=n.length;r===0&&(et("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){et("KeyframeTrack: Time is not a valid number.",this,a,l),e=!1;break}if(o!==null&&o>l){et("KeyframeTrack: Out of order keys.",this,a,l,o),e=!1;break}o=l}if(s!==void 0&&__(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){et("KeyframeTrack: Value is not a valid number.",this,a,c),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===vl,r=e.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=e[a],f=e[a+1];if(c!==f&&(a!==1||c!==e[0]))if(s)l=!0;else{let u=a*n,h=u-n,p=u+n;for(let g=0;g!==n;++g){let v=t[u+g];if(v!==t[h+g]||v!==t[p+g]){l=!0;break}}}if(l){if(a!==o){e[o]=e[a];let u=a*n,h=o*n;for(let p=0;p!==n;++p)t[h+p]=t[u+p]}++o}}if(r>0){e[o]=e[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)t[l+c]=t[a+c];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*n)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),n=this.constructor,s=new n(this.name,e,t);return s.createInterpolant=this.createInterpolant,gl(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function cp(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]+=e}function hp(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]*=e}ai.prototype.ValueTypeName="";ai.prototype.TimeBufferType=Float32Array;ai.prototype.ValueBufferType=Float32Array;ai.prototype.DefaultInterpolation=Pl;var ks=class extends ai{constructor(e,t,n){super(e,t,n)}};ks.prototype.ValueTypeName="bool";ks.prototype.ValueBufferType=Array;ks.prototype.DefaultInterpolation=$o;ks.prototype.InterpolantFactoryMethodLinear=void 0;ks.prototype.InterpolantFactoryMethodSmooth=void 0;var $l=class extends ai{constructor(e,t,n,s){super(e,t,n,s)}};$l.prototype.ValueTypeName="color";var Zl=class extends ai{constructor(e,t,n,s){super(e,t,n,s)}};Zl.prototype.ValueTypeName="number";var Jl=class extends zs{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-t)/(s-t),c=e*a;for(let f=c+a;c!==f;c+=4)Zi.slerpFlat(r,0,o,c-a,o,c,l);return r}},la=class extends ai{constructor(e,t,n,s){super(e,t,n,s)}InterpolantFactoryMethodLinear(e){return new Jl(this.times,this.values,this.getValueSize(),e)}};la.prototype.ValueTypeName="quaternion";la.prototype.InterpolantFactoryMethodSmooth=void 0;var Vs=class extends ai{constructor(e,t,n){super(e,t,n)}};Vs.prototype.ValueTypeName="string";Vs.prototype.ValueBufferType=Array;Vs.prototype.DefaultInterpolation=$o;Vs.prototype.InterpolantFactoryMethodLinear=void 0;Vs.prototype.InterpolantFactoryMethodSmooth=void 0;var Kl=class extends ai{constructor(e,t,n,s){super(e,t,n,s)}};Kl.prototype.ValueTypeName="vector";var jl=class{constructor(e,t,n){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=n,this._abortController=null,this.itemStart=function(f){a++,r===!1&&s.onStart!==void 0&&s.onStart(f,o,a),r=!0},this.itemEnd=function(f){o++,s.onProgress!==void 0&&s.onProgress(f,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(f){s.onError!==void 0&&s.onError(f)},this.resolveURL=function(f){return f=f.normalize("NFC"),l?l(f):f},this.setURLModifier=function(f){return l=f,this},this.addHandler=function(f,u){return c.push(f,u),this},this.removeHandler=function(f){let u=c.indexOf(f);return u!==-1&&c.splice(u,2),this},this.getHandler=function(f){for(let u=0,h=c.length;u<h;u+=2){let p=c[u],g=c[u+1];if(p.global&&(p.lastIndex=0),p.test(f))return g}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},nm=new jl,Ql=class{constructor(e){this.manager=e!==void 0?e:nm,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let n=this;return new Promise(function(s,r){n.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};Ql.DEFAULT_MATERIAL_NAME="__DEFAULT";var _l=new W,xl=new Zi,qi=new W,ca=class extends $n{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new It,this.projectionMatrix=new It,this.projectionMatrixInverse=new It,this.coordinateSystem=xi,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(_l,xl,qi),qi.x===1&&qi.y===1&&qi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(_l,xl,qi.set(1,1,1)).invert()}updateWorldMatrix(e,t,n=!1){super.updateWorldMatrix(e,t,n),this.matrixWorld.decompose(_l,xl,qi),qi.x===1&&qi.y===1&&qi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(_l,xl,qi.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},Us=new W,up=new xt,fp=new xt,Ln=class extends ca{constructor(e=50,t=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=Il*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan($h*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return Il*2*Math.atan(Math.tan($h*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,n){Us.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(Us.x,Us.y).multiplyScalar(-e/Us.z),Us.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(Us.x,Us.y).multiplyScalar(-e/Us.z)}getViewSize(e,t){return this.getViewBounds(e,up,fp),t.subVectors(fp,up)}setViewOffset(e,t,n,s,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan($h*.5*this.fov)/this.zoom,n=2*t,s=this.aspect*n,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,t-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-n,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var ec=class extends ca{constructor(e=-1,t=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-e,o=n+e,a=s+t,l=s-t;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,f=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=f*this.view.offsetY,l=a-f*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}};var Gs=class extends xn{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(e){return super.copy(e),this.instanceCount=e.instanceCount,this}toJSON(){let e=super.toJSON();return e.instanceCount=this.instanceCount,e.isInstancedBufferGeometry=!0,e}};var Kr=-90,jr=1,lo=class extends $n{constructor(e,t,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new Ln(Kr,jr,e,t);s.layers=this.layers,this.add(s);let r=new Ln(Kr,jr,e,t);r.layers=this.layers,this.add(r);let o=new Ln(Kr,jr,e,t);o.layers=this.layers,this.add(o);let a=new Ln(Kr,jr,e,t);a.layers=this.layers,this.add(a);let l=new Ln(Kr,jr,e,t);l.layers=this.layers,this.add(l);let c=new Ln(Kr,jr,e,t);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[n,s,r,o,a,l]=t;for(let c of t)this.remove(c);if(e===xi)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(e===Jo)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let c of t)this.add(c),c.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,f]=this.children,u=e.getRenderTarget(),h=e.getActiveCubeFace(),p=e.getActiveMipmapLevel(),g=e.xr.enabled;e.xr.enabled=!1;let v=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let d=!1;e.isWebGLRenderer===!0?d=e.state.buffers.depth.getReversed():d=e.reversedDepthBuffer,e.setRenderTarget(n,0,s),d&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(n,1,s),d&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(n,2,s),d&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(n,3,s),d&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),e.setRenderTarget(n,4,s),d&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),n.texture.mipmapsAutoUpdate=v,e.setRenderTarget(n,5,s),d&&e.autoClear===!1&&e.clearDepth(),e.render(t,f),e.setRenderTarget(u,h,p),e.xr.enabled=g,n.texture.needsPMREMUpdate=!0}},tc=class extends Ln{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var tf="\\[\\]\\.:\\/",G_=new RegExp("["+tf+"]","g"),nf="[^"+tf+"]",H_="[^"+tf.replace("\\.","")+"]",W_=/((?:WC+[\/:])*)/.source.replace("WC",nf),X_=/(WCOD+)?/.source.replace("WCOD",H_),q_=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",nf),Y_=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",nf),$_=new RegExp("^"+W_+X_+q_+Y_+"$"),Z_=["material","materials","bones","map"],Su=class{constructor(e,t,n){let s=n||Wt.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(e,t)}setValue(e,t){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].unbind()}},Wt=class i{constructor(e,t,n){this.path=t,this.parsedPath=n||i.parseTrackName(t),this.node=i.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,n){return e&&e.isAnimationObjectGroup?new i.Composite(e,t,n):new i(e,t,n)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(G_,"")}static parseTrackName(e){let t=$_.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let n={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);Z_.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return n}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let n=e.skeleton.getBoneByName(t);if(n!==void 0)return n}if(e.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let l=n(a.children);if(l)return l}return null},s=n(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)e[t++]=n[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,n=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=i.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){Je("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=t.objectIndex;switch(n){case"materials":if(!e.material){et("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){et("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){et("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let f=0;f<e.length;f++)if(e[f].name===c){c=f;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){et("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){et("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[n]===void 0){et("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[n]}if(c!==void 0){if(e[c]===void 0){et("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[c]}}let o=e[s];if(o===void 0){let c=t.nodeName;et("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){et("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){et("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};Wt.Composite=Su;Wt.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};Wt.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};Wt.prototype.GetterByBindingType=[Wt.prototype._getValue_direct,Wt.prototype._getValue_array,Wt.prototype._getValue_arrayElement,Wt.prototype._getValue_toArray];Wt.prototype.SetterByBindingTypeAndVersioning=[[Wt.prototype._setValue_direct,Wt.prototype._setValue_direct_setNeedsUpdate,Wt.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[Wt.prototype._setValue_array,Wt.prototype._setValue_array_setNeedsUpdate,Wt.prototype._setValue_array_setMatrixWorldNeedsUpdate],[Wt.prototype._setValue_arrayElement,Wt.prototype._setValue_arrayElement_setNeedsUpdate,Wt.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[Wt.prototype._setValue_fromArray,Wt.prototype._setValue_fromArray_setNeedsUpdate,Wt.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var C1=new Float32Array(1);var ha=class extends Nl{constructor(e,t,n=1){super(e,t),this.isInstancedInterleavedBuffer=!0,this.meshPerAttribute=n}copy(e){return super.copy(e),this.meshPerAttribute=e.meshPerAttribute,this}clone(e){let t=super.clone(e);return t.meshPerAttribute=this.meshPerAttribute,t}toJSON(e){let t=super.toJSON(e);return t.isInstancedInterleavedBuffer=!0,t.meshPerAttribute=this.meshPerAttribute,t}};var dp=new It,ua=class{constructor(e,t,n=0,s=1/0){this.ray=new or(e,t),this.near=n,this.far=s,this.camera=null,this.layers=new so,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(e,t){this.ray.set(e,t)}setFromCamera(e,t){t.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(e.x,e.y,.5).unproject(t).sub(this.ray.origin).normalize(),this.camera=t):t.isOrthographicCamera?(this.ray.origin.set(e.x,e.y,t.projectionMatrix.elements[14]).unproject(t),this.ray.direction.set(0,0,-1).transformDirection(t.matrixWorld),this.camera=t):et("Raycaster: Unsupported camera type: "+t.type)}setFromXRController(e){return dp.identity().extractRotation(e.matrixWorld),this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(dp),this}intersectObject(e,t=!0,n=[]){return Mu(e,this,n,t),n.sort(pp),n}intersectObjects(e,t=!0,n=[]){for(let s=0,r=e.length;s<r;s++)Mu(e[s],this,n,t);return n.sort(pp),n}};function pp(i,e){return i.distance-e.distance}function Mu(i,e,t,n){let s=!0;if(i.layers.test(e.layers)&&i.raycast(e,t)===!1&&(s=!1),s===!0&&n===!0){let r=i.children;for(let o=0,a=r.length;o<a;o++)Mu(r[o],e,t,!0)}}var bu=class{static{this.prototype.isMatrix2=!0}constructor(e,t,n,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let n=0;n<4;n++)this.elements[n]=e[n+t];return this}set(e,t,n,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=n,r[3]=s,this}};function sf(i,e,t,n){let s=J_(n);switch(t){case Hu:return i*e;case pa:return i*e/s.components*s.byteLength;case lc:return i*e/s.components*s.byteLength;case Hs:return i*e*2/s.components*s.byteLength;case cc:return i*e*2/s.components*s.byteLength;case Wu:return i*e*3/s.components*s.byteLength;case ci:return i*e*4/s.components*s.byteLength;case hc:return i*e*4/s.components*s.byteLength;case ma:case ga:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case _a:case xa:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case fc:case pc:return Math.max(i,16)*Math.max(e,8)/4;case uc:case dc:return Math.max(i,8)*Math.max(e,8)/2;case mc:case gc:case xc:case vc:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case _c:case va:case yc:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Sc:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Mc:return Math.floor((i+4)/5)*Math.floor((e+3)/4)*16;case bc:return Math.floor((i+4)/5)*Math.floor((e+4)/5)*16;case wc:return Math.floor((i+5)/6)*Math.floor((e+4)/5)*16;case Ac:return Math.floor((i+5)/6)*Math.floor((e+5)/6)*16;case Tc:return Math.floor((i+7)/8)*Math.floor((e+4)/5)*16;case Ec:return Math.floor((i+7)/8)*Math.floor((e+5)/6)*16;case Cc:return Math.floor((i+7)/8)*Math.floor((e+7)/8)*16;case Rc:return Math.floor((i+9)/10)*Math.floor((e+4)/5)*16;case Pc:return Math.floor((i+9)/10)*Math.floor((e+5)/6)*16;case Ic:return Math.floor((i+9)/10)*Math.floor((e+7)/8)*16;case Lc:return Math.floor((i+9)/10)*Math.floor((e+9)/10)*16;case Dc:return Math.floor((i+11)/12)*Math.floor((e+9)/10)*16;case Nc:return Math.floor((i+11)/12)*Math.floor((e+11)/12)*16;case Uc:case Fc:case Oc:return Math.ceil(i/4)*Math.ceil(e/4)*16;case Bc:case zc:return Math.ceil(i/4)*Math.ceil(e/4)*8;case ya:case kc:return Math.ceil(i/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function J_(i){switch(i){case li:case zu:return{byteLength:1,components:1};case fo:case ku:case Ui:return{byteLength:2,components:1};case oc:case ac:return{byteLength:2,components:4};case Di:case rc:case Ni:return{byteLength:4,components:1};case Vu:case Gu:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Je("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function wm(){let i=null,e=!1,t=null,n=null;function s(r,o){n=i.requestAnimationFrame(s),t(r,o)}return{start:function(){e!==!0&&t!==null&&i!==null&&(n=i.requestAnimationFrame(s),e=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){i=r}}}function j_(i){let e=new WeakMap;function t(a,l){let c=a.array,f=a.usage,u=c.byteLength,h=i.createBuffer();i.bindBuffer(l,h),i.bufferData(l,c,f),a.onUploadCallback();let p;if(c instanceof Float32Array)p=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)p=i.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?p=i.HALF_FLOAT:p=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)p=i.SHORT;else if(c instanceof Uint32Array)p=i.UNSIGNED_INT;else if(c instanceof Int32Array)p=i.INT;else if(c instanceof Int8Array)p=i.BYTE;else if(c instanceof Uint8Array)p=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)p=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:h,type:p,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){let f=l.array,u=l.updateRanges;if(i.bindBuffer(c,a),u.length===0)i.bufferSubData(c,0,f);else{u.sort((p,g)=>p.start-g.start);let h=0;for(let p=1;p<u.length;p++){let g=u[h],v=u[p];v.start<=g.start+g.count+1?g.count=Math.max(g.count,v.start+v.count-g.start):(++h,u[h]=v)}u.length=h+1;for(let p=0,g=u.length;p<g;p++){let v=u[p];i.bufferSubData(c,v.start*f.BYTES_PER_ELEMENT,f,v.start,v.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=e.get(a);l&&(i.deleteBuffer(l.buffer),e.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let f=e.get(a);(!f||f.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=e.get(a);if(c===void 0)e.set(a,t(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var Q_=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,ex=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,tx=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,nx=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,ix=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,sx=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,rx=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,ox=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,ax=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,lx=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,cx=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,hx=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,ux=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,fx=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,dx=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,px=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,mx=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,gx=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,_x=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,xx=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,vx=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,yx=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,Sx=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Mx=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,bx=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,wx=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Ax=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,Tx=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,Ex=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,Cx="gl_FragColor = linearToOutputTexel( gl_FragColor );",Rx=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,Px=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,Ix=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,Lx=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,Dx=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,Nx=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,Ux=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,Fx=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,Ox=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,Bx=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,zx=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,kx=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,Vx=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,Gx=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,Hx=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,Wx=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,Xx=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,qx=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,Yx=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,$x=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,Zx=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,Jx=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,Kx=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,jx=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,Qx=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,ev=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,tv=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,nv=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,iv=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,sv=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,rv=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,ov=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,av=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,lv=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,cv=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,hv=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,uv=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,fv=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,dv=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,pv=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,mv=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,gv=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,_v=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,xv=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,vv=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,yv=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,Sv=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,Mv=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,bv=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,wv=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,Av=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,Tv=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,Ev=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,Cv=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,Rv=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Pv=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Iv=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,Lv=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Dv=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,Nv=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,Uv=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,Fv=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,Ov=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,Bv=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,zv=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,kv=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,Vv=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,Gv=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,Hv=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,Wv=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,Xv=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,qv=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,Yv=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,$v=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,Zv=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,Jv=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,Kv=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,jv=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,Qv=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,ey=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,ty=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,ny=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,iy=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,sy=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,ry=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,oy=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,ay=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,ly=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,cy=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,hy=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,uy=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,fy=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,dy=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,py=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,my=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,gy=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,_y=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,xy=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,vy=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,yy=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Sy=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,My=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,by=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,wy=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Ay=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Ty=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,Ey=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Cy=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Ry=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Py=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Iy=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,ut={alphahash_fragment:Q_,alphahash_pars_fragment:ex,alphamap_fragment:tx,alphamap_pars_fragment:nx,alphatest_fragment:ix,alphatest_pars_fragment:sx,aomap_fragment:rx,aomap_pars_fragment:ox,batching_pars_vertex:ax,batching_vertex:lx,begin_vertex:cx,beginnormal_vertex:hx,bsdfs:ux,iridescence_fragment:fx,bumpmap_pars_fragment:dx,clipping_planes_fragment:px,clipping_planes_pars_fragment:mx,clipping_planes_pars_vertex:gx,clipping_planes_vertex:_x,color_fragment:xx,color_pars_fragment:vx,color_pars_vertex:yx,color_vertex:Sx,common:Mx,defaultnormal_vertex:bx,displacementmap_pars_vertex:wx,displacementmap_vertex:Ax,emissivemap_fragment:Tx,emissivemap_pars_fragment:Ex,colorspace_fragment:Cx,colorspace_pars_fragment:Rx,envmap_fragment:Px,envmap_common_pars_fragment:Ix,envmap_pars_fragment:Lx,envmap_pars_vertex:Dx,envmap_physical_pars_fragment:Wx,envmap_vertex:Nx,fog_vertex:Ux,fog_pars_vertex:Fx,fog_fragment:Ox,fog_pars_fragment:Bx,gradientmap_pars_fragment:zx,lightmap_pars_fragment:kx,lights_lambert_fragment:Vx,lights_lambert_pars_fragment:Gx,lights_pars_begin:Hx,lights_toon_fragment:Xx,lights_toon_pars_fragment:qx,lights_phong_fragment:Yx,lights_phong_pars_fragment:$x,lights_physical_fragment:Zx,lights_physical_pars_fragment:Jx,lights_fragment_begin:Kx,lights_fragment_maps:jx,lights_fragment_end:Qx,lightprobes_pars_fragment:ev,logdepthbuf_fragment:tv,logdepthbuf_pars_fragment:nv,logdepthbuf_pars_vertex:iv,logdepthbuf_vertex:sv,map_fragment:rv,map_pars_fragment:ov,map_particle_fragment:av,map_particle_pars_fragment:lv,metalnessmap_fragment:cv,metalnessmap_pars_fragment:hv,morphinstance_vertex:uv,morphcolor_vertex:fv,morphnormal_vertex:dv,morphtarget_pars_vertex:pv,morphtarget_vertex:mv,normal_fragment_begin:gv,normal_fragment_maps:_v,normal_pars_fragment:xv,normal_pars_vertex:vv,normal_vertex:yv,normalmap_pars_fragment:Sv,clearcoat_normal_fragment_begin:Mv,clearcoat_normal_fragment_maps:bv,clearcoat_pars_fragment:wv,iridescence_pars_fragment:Av,opaque_fragment:Tv,packing:Ev,premultiplied_alpha_fragment:Cv,project_vertex:Rv,dithering_fragment:Pv,dithering_pars_fragment:Iv,roughnessmap_fragment:Lv,roughnessmap_pars_fragment:Dv,shadowmap_pars_fragment:Nv,shadowmap_pars_vertex:Uv,shadowmap_vertex:Fv,shadowmask_pars_fragment:Ov,skinbase_vertex:Bv,skinning_pars_vertex:zv,skinning_vertex:kv,skinnormal_vertex:Vv,specularmap_fragment:Gv,specularmap_pars_fragment:Hv,tonemapping_fragment:Wv,tonemapping_pars_fragment:Xv,transmission_fragment:qv,transmission_pars_fragment:Yv,uv_pars_fragment:$v,uv_pars_vertex:Zv,uv_vertex:Jv,worldpos_vertex:Kv,background_vert:jv,background_frag:Qv,backgroundCube_vert:ey,backgroundCube_frag:ty,cube_vert:ny,cube_frag:iy,depth_vert:sy,depth_frag:ry,distance_vert:oy,distance_frag:ay,equirect_vert:ly,equirect_frag:cy,linedashed_vert:hy,linedashed_frag:uy,meshbasic_vert:fy,meshbasic_frag:dy,meshlambert_vert:py,meshlambert_frag:my,meshmatcap_vert:gy,meshmatcap_frag:_y,meshnormal_vert:xy,meshnormal_frag:vy,meshphong_vert:yy,meshphong_frag:Sy,meshphysical_vert:My,meshphysical_frag:by,meshtoon_vert:wy,meshtoon_frag:Ay,points_vert:Ty,points_frag:Ey,shadow_vert:Cy,shadow_frag:Ry,sprite_vert:Py,sprite_frag:Iy},Ne={common:{diffuse:{value:new ht(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new nt},alphaMap:{value:null},alphaMapTransform:{value:new nt},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new nt}},envmap:{envMap:{value:null},envMapRotation:{value:new nt},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new nt}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new nt}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new nt},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new nt},normalScale:{value:new xt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new nt},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new nt}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new nt}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new nt}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new ht(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new ht(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new nt},alphaTest:{value:0},uvTransform:{value:new nt}},sprite:{diffuse:{value:new ht(16777215)},opacity:{value:1},center:{value:new xt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new nt},alphaMap:{value:null},alphaMapTransform:{value:new nt},alphaTest:{value:0}}},Qi={basic:{uniforms:On([Ne.common,Ne.specularmap,Ne.envmap,Ne.aomap,Ne.lightmap,Ne.fog]),vertexShader:ut.meshbasic_vert,fragmentShader:ut.meshbasic_frag},lambert:{uniforms:On([Ne.common,Ne.specularmap,Ne.envmap,Ne.aomap,Ne.lightmap,Ne.emissivemap,Ne.bumpmap,Ne.normalmap,Ne.displacementmap,Ne.fog,Ne.lights,{emissive:{value:new ht(0)},envMapIntensity:{value:1}}]),vertexShader:ut.meshlambert_vert,fragmentShader:ut.meshlambert_frag},phong:{uniforms:On([Ne.common,Ne.specularmap,Ne.envmap,Ne.aomap,Ne.lightmap,Ne.emissivemap,Ne.bumpmap,Ne.normalmap,Ne.displacementmap,Ne.fog,Ne.lights,{emissive:{value:new ht(0)},specular:{value:new ht(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:ut.meshphong_vert,fragmentShader:ut.meshphong_frag},standard:{uniforms:On([Ne.common,Ne.envmap,Ne.aomap,Ne.lightmap,Ne.emissivemap,Ne.bumpmap,Ne.normalmap,Ne.displacementmap,Ne.roughnessmap,Ne.metalnessmap,Ne.fog,Ne.lights,{emissive:{value:new ht(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:ut.meshphysical_vert,fragmentShader:ut.meshphysical_frag},toon:{uniforms:On([Ne.common,Ne.aomap,Ne.lightmap,Ne.emissivemap,Ne.bumpmap,Ne.normalmap,Ne.displacementmap,Ne.gradientmap,Ne.fog,Ne.lights,{emissive:{value:new ht(0)}}]),vertexShader:ut.meshtoon_vert,fragmentShader:ut.meshtoon_frag},matcap:{uniforms:On([Ne.common,Ne.bumpmap,Ne.normalmap,Ne.displacementmap,Ne.fog,{matcap:{value:null}}]),vertexShader:ut.meshmatcap_vert,fragmentShader:ut.meshmatcap_frag},points:{uniforms:On([Ne.points,Ne.fog]),vertexShader:ut.points_vert,fragmentShader:ut.points_frag},dashed:{uniforms:On([Ne.common,Ne.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:ut.linedashed_vert,fragmentShader:ut.linedashed_frag},depth:{uniforms:On([Ne.common,Ne.displacementmap]),vertexShader:ut.depth_vert,fragmentShader:ut.depth_frag},normal:{uniforms:On([Ne.common,Ne.bumpmap,Ne.normalmap,Ne.displacementmap,{opacity:{value:1}}]),vertexShader:ut.meshnormal_vert,fragmentShader:ut.meshnormal_frag},sprite:{uniforms:On([Ne.sprite,Ne.fog]),vertexShader:ut.sprite_vert,fragmentShader:ut.sprite_frag},background:{uniforms:{uvTransform:{value:new nt},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:ut.background_vert,fragmentShader:ut.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new nt}},vertexShader:ut.backgroundCube_vert,fragmentShader:ut.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:ut.cube_vert,fragmentShader:ut.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:ut.equirect_vert,fragmentShader:ut.equirect_frag},distance:{uniforms:On([Ne.common,Ne.displacementmap,{referencePosition:{value:new W},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:ut.distance_vert,fragmentShader:ut.distance_frag},shadow:{uniforms:On([Ne.lights,Ne.fog,{color:{value:new ht(0)},opacity:{value:1}}]),vertexShader:ut.shadow_vert,fragmentShader:ut.shadow_frag}};Qi.physical={uniforms:On([Qi.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new nt},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new nt},clearcoatNormalScale:{value:new xt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new nt},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new nt},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new nt},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new nt},sheen:{value:0},sheenColor:{value:new ht(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new nt},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new nt},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new nt},transmissionSamplerSize:{value:new xt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new nt},attenuationDistance:{value:0},attenuationColor:{value:new ht(0)},specularColor:{value:new ht(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new nt},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new nt},anisotropyVector:{value:new xt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new nt}}]),vertexShader:ut.meshphysical_vert,fragmentShader:ut.meshphysical_frag};var Hc={r:0,b:0,g:0},Ly=new It,Am=new nt;Am.set(-1,0,0,0,1,0,0,0,1);function Dy(i,e,t,n,s,r){let o=new ht(0),a=s===!0?0:1,l,c,f=null,u=0,h=null;function p(y){let T=y.isScene===!0?y.background:null;if(T&&T.isTexture){let S=y.backgroundBlurriness>0;T=e.get(T,S)}return T}function g(y){let T=!1,S=p(y);S===null?d(o,a):S&&S.isColor&&(d(S,1),T=!0);let C=i.xr.getEnvironmentBlendMode();C==="additive"?t.buffers.color.setClear(0,0,0,1,r):C==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(i.autoClear||T)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function v(y,T){let S=p(T);S&&S.isCubeTexture?(c===void 0&&(c=new vn(new ao(1,1,1),new Ji({name:"BackgroundCubeMaterial",uniforms:pr(Qi.backgroundCube.uniforms),vertexShader:Qi.backgroundCube.vertexShader,fragmentShader:Qi.backgroundCube.fragmentShader,side:pn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(C,E,_){this.matrixWorld.copyPosition(_.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=S,c.material.uniforms.backgroundBlurriness.value=T.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=T.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(Ly.makeRotationFromEuler(T.backgroundRotation)).transpose(),S.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(Am),c.material.toneMapped=mt.getTransfer(S.colorSpace)!==Tt,(f!==S||u!==S.version||h!==i.toneMapping)&&(c.material.needsUpdate=!0,f=S,u=S.version,h=i.toneMapping),c.layers.enableAll(),y.unshift(c,c.geometry,c.material,0,0,null)):S&&S.isTexture&&(l===void 0&&(l=new vn(new aa(2,2),new Ji({name:"BackgroundMaterial",uniforms:pr(Qi.background.uniforms),vertexShader:Qi.background.vertexShader,fragmentShader:Qi.background.fragmentShader,side:yi,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=S,l.material.uniforms.backgroundIntensity.value=T.backgroundIntensity,l.material.toneMapped=mt.getTransfer(S.colorSpace)!==Tt,S.matrixAutoUpdate===!0&&S.updateMatrix(),l.material.uniforms.uvTransform.value.copy(S.matrix),(f!==S||u!==S.version||h!==i.toneMapping)&&(l.material.needsUpdate=!0,f=S,u=S.version,h=i.toneMapping),l.layers.enableAll(),y.unshift(l,l.geometry,l.material,0,0,null))}function d(y,T){y.getRGB(Hc,ef(i)),t.buffers.color.setClear(Hc.r,Hc.g,Hc.b,T,r)}function m(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(y,T=1){o.set(y),a=T,d(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(y){a=y,d(o,a)},render:g,addToRenderList:v,dispose:m}}function Ny(i,e){let t=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=h(null),r=s,o=!1;function a(P,z,V,L,H){let Z=!1,k=u(P,L,V,z);r!==k&&(r=k,c(r.object)),Z=p(P,L,V,H),Z&&g(P,L,V,H),H!==null&&e.update(H,i.ELEMENT_ARRAY_BUFFER),(Z||o)&&(o=!1,S(P,z,V,L),H!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,e.get(H).buffer))}function l(){return i.createVertexArray()}function c(P){return i.bindVertexArray(P)}function f(P){return i.deleteVertexArray(P)}function u(P,z,V,L){let H=L.wireframe===!0,Z=n[z.id];Z===void 0&&(Z={},n[z.id]=Z);let k=P.isInstancedMesh===!0?P.id:0,he=Z[k];he===void 0&&(he={},Z[k]=he);let Y=he[V.id];Y===void 0&&(Y={},he[V.id]=Y);let Q=Y[H];return Q===void 0&&(Q=h(l()),Y[H]=Q),Q}function h(P){let z=[],V=[],L=[];for(let H=0;H<t;H++)z[H]=0,V[H]=0,L[H]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:z,enabledAttributes:V,attributeDivisors:L,object:P,attributes:{},index:null}}function p(P,z,V,L){let H=r.attributes,Z=z.attributes,k=0,he=V.getAttributes();for(let Y in he)if(he[Y].location>=0){let ne=H[Y],de=Z[Y];if(de===void 0&&(Y==="instanceMatrix"&&P.instanceMatrix&&(de=P.instanceMatrix),Y==="instanceColor"&&P.instanceColor&&(de=P.instanceColor)),ne===void 0||ne.attribute!==de||de&&ne.data!==de.data)return!0;k++}return r.attributesNum!==k||r.index!==L}function g(P,z,V,L){let H={},Z=z.attributes,k=0,he=V.getAttributes();for(let Y in he)if(he[Y].location>=0){let ne=Z[Y];ne===void 0&&(Y==="instanceMatrix"&&P.instanceMatrix&&(ne=P.instanceMatrix),Y==="instanceColor"&&P.instanceColor&&(ne=P.instanceColor));let de={};de.attribute=ne,ne&&ne.data&&(de.data=ne.data),H[Y]=de,k++}r.attributes=H,r.attributesNum=k,r.index=L}function v(){let P=r.newAttributes;for(let z=0,V=P.length;z<V;z++)P[z]=0}function d(P){m(P,0)}function m(P,z){let V=r.newAttributes,L=r.enabledAttributes,H=r.attributeDivisors;V[P]=1,L[P]===0&&(i.enableVertexAttribArray(P),L[P]=1),H[P]!==z&&(i.vertexAttribDivisor(P,z),H[P]=z)}function y(){let P=r.newAttributes,z=r.enabledAttributes;for(let V=0,L=z.length;V<L;V++)z[V]!==P[V]&&(i.disableVertexAttribArray(V),z[V]=0)}function T(P,z,V,L,H,Z,k){k===!0?i.vertexAttribIPointer(P,z,V,H,Z):i.vertexAttribPointer(P,z,V,L,H,Z)}function S(P,z,V,L){v();let H=L.attributes,Z=V.getAttributes(),k=z.defaultAttributeValues;for(let he in Z){let Y=Z[he];if(Y.location>=0){let Q=H[he];if(Q===void 0&&(he==="instanceMatrix"&&P.instanceMatrix&&(Q=P.instanceMatrix),he==="instanceColor"&&P.instanceColor&&(Q=P.instanceColor)),Q!==void 0){let ne=Q.normalized,de=Q.itemSize,pe=e.get(Q);if(pe===void 0)continue;let ee=pe.buffer,_e=pe.type,ye=pe.bytesPerElement,Re=_e===i.INT||_e===i.UNSIGNED_INT||Q.gpuType===rc;if(Q.isInterleavedBufferAttribute){let we=Q.data,qe=we.isInterleavedBuffer===!0?we.stride:we.itemSize,rt=Q.offset;if(we.isInstancedInterleavedBuffer||we.isInstancedBufferAttribute){for(let We=0;We<Y.locationSize;We++)m(Y.location+We,we.meshPerAttribute);P.isInstancedMesh!==!0&&L._maxInstanceCount===void 0&&(L._maxInstanceCount=we.meshPerAttribute*we.count)}else for(let We=0;We<Y.locationSize;We++)d(Y.location+We);i.bindBuffer(i.ARRAY_BUFFER,ee);for(let We=0;We<Y.locationSize;We++)T(Y.location+We,de/Y.locationSize,_e,ne,qe*ye,(rt+de/Y.locationSize*We)*ye,Re)}else{if(Q.isInstancedBufferAttribute){for(let we=0;we<Y.locationSize;we++)m(Y.location+we,Q.meshPerAttribute);P.isInstancedMesh!==!0&&L._maxInstanceCount===void 0&&(L._maxInstanceCount=Q.meshPerAttribute*Q.count)}else for(let we=0;we<Y.locationSize;we++)d(Y.location+we);i.bindBuffer(i.ARRAY_BUFFER,ee);for(let we=0;we<Y.locationSize;we++)T(Y.location+we,de/Y.locationSize,_e,ne,de*ye,de/Y.locationSize*we*ye,Re)}}else if(k!==void 0){let ne=k[he];if(ne!==void 0)switch(ne.length){case 2:i.vertexAttrib2fv(Y.location,ne);break;case 3:i.vertexAttrib3fv(Y.location,ne);break;case 4:i.vertexAttrib4fv(Y.location,ne);break;default:i.vertexAttrib1fv(Y.location,ne)}}}}y()}function C(){U();for(let P in n){let z=n[P];for(let V in z){let L=z[V];for(let H in L){let Z=L[H];for(let k in Z)f(Z[k].object),delete Z[k];delete L[H]}}delete n[P]}}function E(P){if(n[P.id]===void 0)return;let z=n[P.id];for(let V in z){let L=z[V];for(let H in L){let Z=L[H];for(let k in Z)f(Z[k].object),delete Z[k];delete L[H]}}delete n[P.id]}function _(P){for(let z in n){let V=n[z];for(let L in V){let H=V[L];if(H[P.id]===void 0)continue;let Z=H[P.id];for(let k in Z)f(Z[k].object),delete Z[k];delete H[P.id]}}}function b(P){for(let z in n){let V=n[z],L=P.isInstancedMesh===!0?P.id:0,H=V[L];if(H!==void 0){for(let Z in H){let k=H[Z];for(let he in k)f(k[he].object),delete k[he];delete H[Z]}delete V[L],Object.keys(V).length===0&&delete n[z]}}}function U(){D(),o=!0,r!==s&&(r=s,c(r.object))}function D(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:U,resetDefaultState:D,dispose:C,releaseStatesOfGeometry:E,releaseStatesOfObject:b,releaseStatesOfProgram:_,initAttributes:v,enableAttribute:d,disableUnusedAttributes:y}}function Uy(i,e,t){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),t.update(c,n,1)}function o(l,c,f){f!==0&&(i.drawArraysInstanced(n,l,c,f),t.update(c,n,f))}function a(l,c,f){if(f===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,f);let h=0;for(let p=0;p<f;p++)h+=c[p];t.update(h,n,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function Fy(i,e,t,n){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let _=e.get("EXT_texture_filter_anisotropic");s=i.getParameter(_.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(_){return!(_!==ci&&n.convert(_)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(_){let b=_===Ui&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(_!==li&&_!==Ni&&!b&&n.convert(_)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(_){if(_==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";_="mediump"}return _==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=t.precision!==void 0?t.precision:"highp",f=l(c);f!==c&&(Je("WebGLRenderer:",c,"not supported, using",f,"instead."),c=f);let u=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),h=t.logarithmicDepthBuffer===!0&&u===!1;t.reversedDepthBuffer===!0&&u===!1&&Je("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&u===!0&&Je("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let p=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),g=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),v=i.getParameter(i.MAX_TEXTURE_SIZE),d=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),m=i.getParameter(i.MAX_VERTEX_ATTRIBS),y=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),T=i.getParameter(i.MAX_VARYING_VECTORS),S=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),C=i.getParameter(i.MAX_SAMPLES),E=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:h,reversedDepthBuffer:u,maxTextures:p,maxVertexTextures:g,maxTextureSize:v,maxCubemapSize:d,maxAttributes:m,maxVertexUniforms:y,maxVaryings:T,maxFragmentUniforms:S,maxSamples:C,samples:E}}function Oy(i){let e=this,t=null,n=0,s=!1,r=!1,o=new Ii,a=new nt,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,h){let p=u.length!==0||h||n!==0||s;return s=h,n=u.length,p},this.beginShadows=function(){r=!0,f(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,h){t=f(u,h,0)},this.setState=function(u,h,p){let g=u.clippingPlanes,v=u.clipIntersection,d=u.clipShadows,m=i.get(u);if(!s||g===null||g.length===0||r&&!d)r?f(null):c();else{let y=r?0:n,T=y*4,S=m.clippingState||null;l.value=S,S=f(g,h,T,p);for(let C=0;C!==T;++C)S[C]=t[C];m.clippingState=S,this.numIntersection=v?this.numPlanes:0,this.numPlanes+=y}};function c(){l.value!==t&&(l.value=t,l.needsUpdate=n>0),e.numPlanes=n,e.numIntersection=0}function f(u,h,p,g){let v=u!==null?u.length:0,d=null;if(v!==0){if(d=l.value,g!==!0||d===null){let m=p+v*4,y=h.matrixWorldInverse;a.getNormalMatrix(y),(d===null||d.length<m)&&(d=new Float32Array(m));for(let T=0,S=p;T!==v;++T,S+=4)o.copy(u[T]).applyMatrix4(y,a),o.normal.toArray(d,S),d[S+3]=o.constant}l.value=d,l.needsUpdate=!0}return e.numPlanes=v,e.numIntersection=0,d}}var ba=class extends ri{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let n={width:e,height:e,depth:1},s=[n,n,n,n,n,n];this.texture=new sa(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new ao(5,5,5),r=new Ji({name:"CubemapFromEquirect",uniforms:pr(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:pn,blending:cr});r.uniforms.tEquirect.value=t;let o=new vn(s,r),a=t.minFilter;return t.minFilter===vs&&(t.minFilter=dn),new lo(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,n=!0,s=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,n,s);e.setRenderTarget(r)}},im=256,By=3,zy=20,Tm=256,Em=16,ky=3,Vy=new W,Gy=new ht,Xc=class i{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new lo(1,10,null),this._boxMesh=new vn(new ao(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,n=.1,s=100,r={}){let{size:o=256,position:a=Vy}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),f=this._getSourceTarget(!0);t>0&&(f.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,h=l.autoClearColor,p=l.autoClearDepth,g=l.autoClearStencil,v=e.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,v===null&&(e.background=l.getClearColor(Gy));let d=new lo(n,s,f);return d.position.copy(a),d.update(l,e),l.autoClear=u,l.autoClearColor=h,l.autoClearDepth=p,l.autoClearStencil=g,e.background=v,t>0&&(f.texture.mipmapsAutoUpdate=!0,this._blur(c,t)),this._applyPMREM(c),c}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=om(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=rm(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(im,Jp(e))}_fromTexture(e,t){e.mapping===ur||e.mapping===uo?this._setSize(e.image.length===0?im:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let n=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(n),n}_allocateTarget(){let e=this._cubeSize,t=sm(e,!1,!1),n=Math.log2(e)-By;for(let s=0;s<=n;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==t||e&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=sm(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===ur||e.mapping===uo?(this._cubemapMaterial===null&&(this._cubemapMaterial=om()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=rm()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=Hy(),this._integrationMaterial=Wy());let t=this._cubeSize,n=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/Em);for(let o=0;o<=n;o++){let a=i.lodToRoughness(o,n);if(o>n-ky)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let l=a>0?Math.log2(t)+.5*Math.log2(6/(Tm*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=Xy());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,n),s.envMap.value=e.texture,this._renderCube(r,0,n)}};function sm(i,e,t){return new ba(i,{minFilter:vs,generateMipmaps:e,type:Ui,colorSpace:ir,depthBuffer:t})}function wa(i,e,t){return new Ji({name:i,uniforms:e,vertexShader:ut.cube_vert,fragmentShader:t,side:pn,blending:cr,depthTest:!1,depthWrite:!1})}function Hy(){return wa("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${Tm}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Wy(){return wa("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:Em}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Xy(){return wa("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${zy}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function rm(){return wa("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function om(){return wa("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function qy(i){let e=new WeakMap,t=new WeakMap,n=null;function s(h,p=!1){return h==null?null:p?o(h):r(h)}function r(h){if(h&&h.isTexture){let p=h.mapping;if(p===nc||p===ic)if(e.has(h)){let g=e.get(h).texture;return a(g,h.mapping)}else{let g=h.image;if(g&&g.height>0){let v=new ba(g.height);return v.fromEquirectangularTexture(i,h),e.set(h,v),h.addEventListener("dispose",c),a(v.texture,h.mapping)}else return null}}return h}function o(h){if(h&&h.isTexture&&h.isPMREMTexture!==!0){let p=h.mapping,g=p===nc||p===ic,v=p===ur||p===uo;if(g||v){let d=t.get(h),m=d!==void 0?d.texture.pmremVersion:0;if(h.isRenderTargetTexture&&h.pmremVersion!==m)return n===null&&(n=new Xc(i)),d=g?n.fromEquirectangular(h,d):n.fromCubemap(h,d),d.texture.pmremVersion=h.pmremVersion,t.set(h,d),d.texture;if(d!==void 0)return d.texture;{let y=h.image;return g&&y&&y.height>0||v&&y&&l(y)?(n===null&&(n=new Xc(i)),d=g?n.fromEquirectangular(h):n.fromCubemap(h),d.texture.pmremVersion=h.pmremVersion,t.set(h,d),h.addEventListener("dispose",f),d.texture):null}}}return h}function a(h,p){return p===nc?h.mapping=ur:p===ic&&(h.mapping=uo),h}function l(h){let p=0,g=6;for(let v=0;v<g;v++)h[v]!==void 0&&p++;return p===g}function c(h){let p=h.target;p.removeEventListener("dispose",c);let g=e.get(p);g!==void 0&&(e.delete(p),g.dispose())}function f(h){let p=h.target;p.removeEventListener("dispose",f);let g=t.get(p);g!==void 0&&(t.delete(p),g.dispose())}function u(){e=new WeakMap,t=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:u}}function Yy(i){let e={};function t(n){if(e[n]!==void 0)return e[n];let s=i.getExtension(n);return e[n]=s,s}return{has:function(n){return t(n)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(n){let s=t(n);return s===null&&Yo("WebGLRenderer: "+n+" extension not supported."),s}}}function $y(i,e,t,n){let s={},r=new WeakMap,o=new FinalizationRegistry(g=>delete s[g]);function a(g){l(g.target)}function l(g){g.index!==null&&e.remove(g.index);for(let d in g.attributes)e.remove(g.attributes[d]);g.removeEventListener("dispose",a),delete s[g.id],o.unregister(g);let v=r.get(g);v&&(e.remove(v),r.delete(g)),n.releaseStatesOfGeometry(g),g.isInstancedBufferGeometry===!0&&delete g._maxInstanceCount,t.memory.geometries--}function c(g,v){return s[v.id]!==void 0||(v.addEventListener("dispose",a),s[v.id]=new WeakRef(v),o.register(v,v.id,v),t.memory.geometries++),v}function f(g){let v=g.attributes;for(let d in v)e.update(v[d],i.ARRAY_BUFFER)}function u(g){let v=g.index,d=g.attributes.position,m=0;if(d===void 0)return;let y=v!==null?v.array.length:d.array.length/3-1,T=d.count>=65535?ta:ea,S=new T(Math.ceil(y/3)*6,1),C=S.array;if(v!==null){let _=v.array;m=v.version;for(let b=0,U=0;b<y;b+=3){let D=_[b+0],P=_[b+1],z=_[b+2];C[U++]=D,C[U++]=P,C[U++]=P,C[U++]=z,C[U++]=z,C[U++]=D}}else{m=d.version;for(let _=0,b=0;_<y;_+=3){let U=_+0,D=_+1,P=_+2;C[b++]=U,C[b++]=D,C[b++]=D,C[b++]=P,C[b++]=P,C[b++]=U}}S.version=m;let E=r.get(g);E&&e.remove(E),r.set(g,S)}function h(g){let v=r.get(g);if(v){let d=g.index;d!==null&&v.version<d.version&&u(g)}else u(g);return r.get(g)}function p(){for(let g in s){let v=s[g].deref();v!==void 0&&l(v)}}return{get:c,update:f,getWireframeAttribute:h,dispose:p}}function Zy(i,e,t){let n;function s(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,h){i.drawElements(n,h,r,u*o),t.update(h,n,1)}function c(u,h,p){p!==0&&(i.drawElementsInstanced(n,h,r,u*o,p),t.update(h,n,p))}function f(u,h,p){if(p===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,h,0,r,u,0,p);let v=0;for(let d=0;d<p;d++)v+=h[d];t.update(v,n,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=f}function Jy(i){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(t.calls++,o){case i.TRIANGLES:t.triangles+=a*(r/3);break;case i.LINES:t.lines+=a*(r/2);break;case i.LINE_STRIP:t.lines+=a*(r-1);break;case i.LINE_LOOP:t.lines+=a*r;break;case i.POINTS:t.points+=a*r;break;default:et("WebGLInfo: Unknown draw mode:",o);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:n}}function Ky(i,e,t){let n=new WeakMap,s=new Lt;function r(o,a,l){let c=o.morphTargetInfluences,f=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=f!==void 0?f.length:0,h=n.get(a);if(h===void 0||h.count!==u){let U=function(){_.dispose(),n.delete(a),a.removeEventListener("dispose",U)};h!==void 0&&h.texture.dispose();let p=a.morphAttributes.position!==void 0,g=a.morphAttributes.normal!==void 0,v=a.morphAttributes.color!==void 0,d=a.morphAttributes.position||[],m=a.morphAttributes.normal||[],y=a.morphAttributes.color||[],T=0;p===!0&&(T=1),g===!0&&(T=2),v===!0&&(T=3);let S=a.attributes.position.count*T,C=1;S>e.maxTextureSize&&(C=Math.ceil(S/e.maxTextureSize),S=e.maxTextureSize);let E=new Float32Array(S*C*4*u),_=new Qo(E,S,C,u);_.type=Ni,_.needsUpdate=!0;let b=T*4;for(let D=0;D<u;D++){let P=d[D],z=m[D],V=y[D],L=S*C*4*D;for(let H=0;H<P.count;H++){let Z=H*b;p===!0&&(s.fromBufferAttribute(P,H),E[L+Z+0]=s.x,E[L+Z+1]=s.y,E[L+Z+2]=s.z,E[L+Z+3]=0),g===!0&&(s.fromBufferAttribute(z,H),E[L+Z+4]=s.x,E[L+Z+5]=s.y,E[L+Z+6]=s.z,E[L+Z+7]=0),v===!0&&(s.fromBufferAttribute(V,H),E[L+Z+8]=s.x,E[L+Z+9]=s.y,E[L+Z+10]=s.z,E[L+Z+11]=V.itemSize===4?s.w:1)}}h={count:u,texture:_,size:new xt(S,C)},n.set(a,h),a.addEventListener("dispose",U)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,t);else{let p=0;for(let v=0;v<c.length;v++)p+=c[v];let g=a.morphTargetsRelative?1:1-p;l.getUniforms().setValue(i,"morphTargetBaseInfluence",g),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",h.texture,t),l.getUniforms().setValue(i,"morphTargetsTextureSize",h.size)}return{update:r}}function jy(i,e,t,n,s){let r=new WeakMap;function o(c){let f=s.render.frame,u=c.geometry,h=e.get(c,u);if(r.get(h)!==f&&(e.update(h),r.set(h,f)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==f&&(t.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&t.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,f))),c.isSkinnedMesh){let p=c.skeleton;r.get(p)!==f&&(p.update(),r.set(p,f))}return h}function a(){r=new WeakMap}function l(c){let f=c.target;f.removeEventListener("dispose",l),n.releaseStatesOfObject(f),t.remove(f.instanceMatrix),f.instanceColor!==null&&t.remove(f.instanceColor)}return{update:o,dispose:a}}var Qy={[Iu]:"LINEAR_TONE_MAPPING",[Lu]:"REINHARD_TONE_MAPPING",[Du]:"CINEON_TONE_MAPPING",[Nu]:"ACES_FILMIC_TONE_MAPPING",[Fu]:"AGX_TONE_MAPPING",[Ou]:"NEUTRAL_TONE_MAPPING",[Uu]:"CUSTOM_TONE_MAPPING"};function eS(i,e,t,n,s,r){let o=new ri(e,t,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,f=new xn;f.setAttribute("position",new qn([-1,3,0,-1,-1,0,3,-1,0],3)),f.setAttribute("uv",new qn([0,2,0,0,2,0],2));let u=new oi({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),h=new vn(f,u),p=new ec(-1,1,1,-1,0,1),g=null,v=null,d=!1,m,y=null,T=[],S=!1;this.setSize=function(C,E){o.setSize(C,E),a!==null&&a.setSize(C,E),l!==null&&l.setSize(C,E);for(let _=0;_<T.length;_++){let b=T[_];b.setSize&&b.setSize(C,E)}},this.setEffects=function(C){T=C,S=T.length>0&&T[0].isRenderPass===!0;let E=o.width,_=o.height;T.length>0&&a===null&&(a=new ri(E,_,{type:Ui,depthBuffer:!1,stencilBuffer:!1}),l=new ri(E,_,{type:Ui,depthBuffer:!1,stencilBuffer:!1}));let b=s===!0&&T.some(U=>U.needsDepthTexture===!0);b!==(o.depthTexture!==null)&&(b===!0&&c===null&&(c=new xs(E,_),r===!0&&(c.format=ys,c.type=fr)),o.dispose(),o.depthTexture=b?c:null,o.resolveDepthBuffer=b,o.storeMultisampledDepthBuffer=b);for(let U=0;U<T.length;U++){let D=T[U];D.setSize&&D.setSize(E,_),b&&D.needsDepthTexture===!0&&D.setDepthTexture&&D.setDepthTexture(c)}},this.begin=function(C,E){if(d||C.toneMapping===Ki&&T.length===0)return!1;if(y=E,E!==null){let _=E.width,b=E.height;(o.width!==_||o.height!==b)&&this.setSize(_,b)}return S===!1&&C.setRenderTarget(o),m=C.toneMapping,C.toneMapping=Ki,!0},this.hasRenderPass=function(){return S},this.end=function(C,E){C.toneMapping=m,d=!0;let _=o,b=a;for(let U=0;U<T.length;U++){let D=T[U];D.enabled!==!1&&(D.render(C,b,_,E),D.needsSwap!==!1&&(_=b,b=b===a?l:a))}if(g!==C.outputColorSpace||v!==C.toneMapping){g=C.outputColorSpace,v=C.toneMapping,u.defines={},mt.getTransfer(g)===Tt&&(u.defines.SRGB_TRANSFER="");let U=Qy[v];U&&(u.defines[U]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=_.texture,C.setRenderTarget(y),C.render(h,p),y=null,d=!1},this.isCompositing=function(){return d},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),f.dispose(),u.dispose()}}var Cm=new Yn,Rm=new xs(1,1),Pm=new ra(1),Im=new Qo,Lm=new io,Dm=new sa,am=[],lm=[],cm=new Float32Array(16),hm=new Float32Array(9),um=new Float32Array(4);function mo(i,e,t){let n=i[0];if(n<=0||n>0)return i;let s=e*t,r=am[s];if(r===void 0&&(r=new Float32Array(s),am[s]=r),e!==0){n.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,i[o].toArray(r,a)}return r}function yn(i,e){if(i.length!==e.length)return!1;for(let t=0,n=i.length;t<n;t++)if(i[t]!==e[t])return!1;return!0}function Sn(i,e){for(let t=0,n=e.length;t<n;t++)i[t]=e[t]}function Yc(i,e){let t=lm[e];t===void 0&&(t=new Int32Array(e),lm[e]=t);for(let n=0;n!==e;++n)t[n]=i.allocateTextureUnit();return t}function tS(i,e){let t=this.cache;t[0]!==e&&(i.uniform1f(this.addr,e),t[0]=e)}function nS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(yn(t,e))return;i.uniform2fv(this.addr,e),Sn(t,e)}}function iS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(i.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(yn(t,e))return;i.uniform3fv(this.addr,e),Sn(t,e)}}function sS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(yn(t,e))return;i.uniform4fv(this.addr,e),Sn(t,e)}}function rS(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(yn(t,e))return;i.uniformMatrix2fv(this.addr,!1,e),Sn(t,e)}else{if(yn(t,n))return;um.set(n),i.uniformMatrix2fv(this.addr,!1,um),Sn(t,n)}}function oS(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(yn(t,e))return;i.uniformMatrix3fv(this.addr,!1,e),Sn(t,e)}else{if(yn(t,n))return;hm.set(n),i.uniformMatrix3fv(this.addr,!1,hm),Sn(t,n)}}function aS(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(yn(t,e))return;i.uniformMatrix4fv(this.addr,!1,e),Sn(t,e)}else{if(yn(t,n))return;cm.set(n),i.uniformMatrix4fv(this.addr,!1,cm),Sn(t,n)}}function lS(i,e){let t=this.cache;t[0]!==e&&(i.uniform1i(this.addr,e),t[0]=e)}function cS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(yn(t,e))return;i.uniform2iv(this.addr,e),Sn(t,e)}}function hS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(yn(t,e))return;i.uniform3iv(this.addr,e),Sn(t,e)}}function uS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(yn(t,e))return;i.uniform4iv(this.addr,e),Sn(t,e)}}function fS(i,e){let t=this.cache;t[0]!==e&&(i.uniform1ui(this.addr,e),t[0]=e)}function dS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(yn(t,e))return;i.uniform2uiv(this.addr,e),Sn(t,e)}}function pS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(yn(t,e))return;i.uniform3uiv(this.addr,e),Sn(t,e)}}function mS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(yn(t,e))return;i.uniform4uiv(this.addr,e),Sn(t,e)}}function $c(i){return i.version===0&&(i.compareFunction=Ku,i.needsUpdate=!0),i}function gS(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=$c(Rm):r=Cm,t.setTexture2D(e||r,s)}function _S(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture3D(e||Lm,s)}function xS(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=$c(Pm):r=Dm,t.setTextureCube(e||r,s)}function vS(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture2DArray(e||Im,s)}function yS(i){switch(i){case 5126:return tS;case 35664:return nS;case 35665:return iS;case 35666:return sS;case 35674:return rS;case 35675:return oS;case 35676:return aS;case 5124:case 35670:return lS;case 35667:case 35671:return cS;case 35668:case 35672:return hS;case 35669:case 35673:return uS;case 5125:return fS;case 36294:return dS;case 36295:return pS;case 36296:return mS;case 35678:case 36198:case 36298:case 36306:case 35682:return gS;case 35679:case 36299:case 36307:return _S;case 35680:case 36300:case 36308:case 36293:return xS;case 36289:case 36303:case 36311:case 36292:return vS}}function SS(i,e){i.uniform1fv(this.addr,e)}function MS(i,e){let t=mo(e,this.size,2);i.uniform2fv(this.addr,t)}function bS(i,e){let t=mo(e,this.size,3);i.uniform3fv(this.addr,t)}function wS(i,e){let t=mo(e,this.size,4);i.uniform4fv(this.addr,t)}function AS(i,e){let t=mo(e,this.size,4);i.uniformMatrix2fv(this.addr,!1,t)}function TS(i,e){let t=mo(e,this.size,9);i.uniformMatrix3fv(this.addr,!1,t)}function ES(i,e){let t=mo(e,this.size,16);i.uniformMatrix4fv(this.addr,!1,t)}function CS(i,e){i.uniform1iv(this.addr,e)}function RS(i,e){i.uniform2iv(this.addr,e)}function PS(i,e){i.uniform3iv(this.addr,e)}function IS(i,e){i.uniform4iv(this.addr,e)}function LS(i,e){i.uniform1uiv(this.addr,e)}function DS(i,e){i.uniform2uiv(this.addr,e)}function NS(i,e){i.uniform3uiv(this.addr,e)}function US(i,e){i.uniform4uiv(this.addr,e)}function FS(i,e,t){let n=this.cache,s=e.length,r=Yc(t,s);yn(n,r)||(i.uniform1iv(this.addr,r),Sn(n,r));let o;this.type===i.SAMPLER_2D_SHADOW?o=$c(Rm):o=Cm;for(let a=0;a!==s;++a)t.setTexture2D(e[a]||o,r[a])}function OS(i,e,t){let n=this.cache,s=e.length,r=Yc(t,s);yn(n,r)||(i.uniform1iv(this.addr,r),Sn(n,r));for(let o=0;o!==s;++o)t.setTexture3D(e[o]||Lm,r[o])}function BS(i,e,t){let n=this.cache,s=e.length,r=Yc(t,s);yn(n,r)||(i.uniform1iv(this.addr,r),Sn(n,r));let o;this.type===i.SAMPLER_CUBE_SHADOW?o=$c(Pm):o=Dm;for(let a=0;a!==s;++a)t.setTextureCube(e[a]||o,r[a])}function zS(i,e,t){let n=this.cache,s=e.length,r=Yc(t,s);yn(n,r)||(i.uniform1iv(this.addr,r),Sn(n,r));for(let o=0;o!==s;++o)t.setTexture2DArray(e[o]||Im,r[o])}function kS(i){switch(i){case 5126:return SS;case 35664:return MS;case 35665:return bS;case 35666:return wS;case 35674:return AS;case 35675:return TS;case 35676:return ES;case 5124:case 35670:return CS;case 35667:case 35671:return RS;case 35668:case 35672:return PS;case 35669:case 35673:return IS;case 5125:return LS;case 36294:return DS;case 36295:return NS;case 36296:return US;case 35678:case 36198:case 36298:case 36306:case 35682:return FS;case 35679:case 36299:case 36307:return OS;case 35680:case 36300:case 36308:case 36293:return BS;case 36289:case 36303:case 36311:case 36292:return zS}}var af=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.setValue=yS(t.type)}},lf=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=kS(t.type)}},cf=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,n){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(e,t[a.id],n)}}},rf=/(\w+)(\])?(\[|\.)?/g;function fm(i,e){i.seq.push(e),i.map[e.id]=e}function VS(i,e,t){let n=i.name,s=n.length;for(rf.lastIndex=0;;){let r=rf.exec(n),o=rf.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){fm(t,c===void 0?new af(a,i,e):new lf(a,i,e));break}else{let u=t.map[a];u===void 0&&(u=new cf(a),fm(t,u)),t=u}}}var po=class{constructor(e,t){this.seq=[],this.map={};let n=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=e.getActiveUniform(t,o),l=e.getUniformLocation(t,a.name);VS(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,n,s){let r=this.map[t];r!==void 0&&r.setValue(e,n,s)}setOptional(e,t,n){let s=t[n];s!==void 0&&this.setValue(e,n,s)}static upload(e,t,n,s){for(let r=0,o=t.length;r!==o;++r){let a=t[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(e,l.value,s)}}static seqWithValue(e,t){let n=[];for(let s=0,r=e.length;s!==r;++s){let o=e[s];o.id in t&&n.push(o)}return n}};function dm(i,e,t){let n=i.createShader(e);return i.shaderSource(n,t),i.compileShader(n),n}var GS=37297,HS=0;function WS(i,e){let t=i.split(`
`),n=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=s;o<r;o++){let a=o+1;n.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return n.join(`
`)}var pm=new nt;function XS(i){mt._getMatrix(pm,mt.workingColorSpace,i);let e=`mat3( ${pm.elements.map(t=>t.toFixed(4))} )`;switch(mt.getTransfer(i)){case Zo:return[e,"LinearTransferOETF"];case Tt:return[e,"sRGBTransferOETF"];default:return Je("WebGLProgram: Unsupported color space: ",i),[e,"LinearTransferOETF"]}}function mm(i,e,t){let n=i.getShaderParameter(e,i.COMPILE_STATUS),r=(i.getShaderInfoLog(e)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+WS(i.getShaderSource(e),a)}else return r}function qS(i,e){let t=XS(e);return[`vec4 ${i}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var YS={[Iu]:"Linear",[Lu]:"Reinhard",[Du]:"Cineon",[Nu]:"ACESFilmic",[Fu]:"AgX",[Ou]:"Neutral",[Uu]:"Custom"};function $S(i,e){let t=YS[e];return t===void 0?(Je("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var Wc=new W;function ZS(){mt.getLuminanceCoefficients(Wc);let i=Wc.x.toFixed(4),e=Wc.y.toFixed(4),t=Wc.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function JS(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Ma).join(`
`)}function KS(i){let e=[];for(let t in i){let n=i[t];n!==!1&&e.push("#define "+t+" "+n)}return e.join(`
`)}function jS(i,e){let t={},n=i.getProgramParameter(e,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(e,s),o=r.name,a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:i.getAttribLocation(e,o),locationSize:a}}return t}function Ma(i){return i!==""}function gm(i,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function _m(i,e){return i.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var QS=/^[ \t]*#include +<([\w\d./]+)>/gm;function hf(i){return i.replace(QS,eM)}function eM(i,e){let t=ut[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return hf(t)}var tM=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function xm(i){return i.replace(tM,nM)}function nM(i,e,t,n){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function vm(i){let e=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?e+=`
#define HIGH_PRECISION`:i.precision==="mediump"?e+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(e+=`
#define LOW_PRECISION`),e}var iM={[fa]:"SHADOWMAP_TYPE_PCF",[co]:"SHADOWMAP_TYPE_VSM"};function sM(i){return iM[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var rM={[uo]:"ENVMAP_MODE_REFRACTION"};function oM(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":rM[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var aM={[Pu]:"ENVMAP_BLENDING_MULTIPLY",[Fp]:"ENVMAP_BLENDING_MIX",[Op]:"ENVMAP_BLENDING_ADD"};function lM(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":aM[i.combine]||"ENVMAP_BLENDING_NONE"}function cM(i,e,t,n){let s=i.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,l=sM(t),c=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",f=oM(t),u=lM(t),h=JS(t),p=KS(r),g=s.createProgram(),v,d,m=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(v=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,p].filter(Ma).join(`
`),v.length>0&&(v+=`
`),d=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,p].filter(Ma).join(`
`),d.length>0&&(d+=`
`)):(v=[vm(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,p,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+f:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Ma).join(`
`),d=[vm(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,p,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+c:"",t.envMap?"#define "+f:"",t.envMap?"#define "+u:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==Ki?"#define TONE_MAPPING":"",t.toneMapping!==Ki?ut.tonemapping_pars_fragment:"",t.toneMapping!==Ki?$S("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",ut.colorspace_pars_fragment,qS("linearToOutputTexel",t.outputColorSpace),ZS(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(Ma).join(`
`)),o=hf(o),o=gm(o,t),o=_m(o,t),a=hf(a),a=gm(a,t),a=_m(a,t),o=xm(o),a=xm(a),t.isRawShaderMaterial!==!0&&(m=`#version 300 es
`,v=[h,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+v,d=["#define varying in",t.glslVersion===Mi?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===Mi?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+d);let y=m+v+o,T=m+d+a,S=dm(s,s.VERTEX_SHADER,y),C=dm(s,s.FRAGMENT_SHADER,T);s.attachShader(g,S),s.attachShader(g,C),t.index0AttributeName!==void 0?s.bindAttribLocation(g,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(g,0,"position"),s.linkProgram(g);function E(D){if(i.debug.checkShaderErrors){let P=s.getProgramInfoLog(g)||"",z=s.getShaderInfoLog(S)||"",V=s.getShaderInfoLog(C)||"",L=P.trim(),H=z.trim(),Z=V.trim(),k=!0,he=!0;if(s.getProgramParameter(g,s.LINK_STATUS)===!1)if(k=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,g,S,C);else{let Y=mm(s,S,"vertex"),Q=mm(s,C,"fragment");et("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(g,s.VALIDATE_STATUS)+`

Material Name: `+D.name+`
Material Type: `+D.type+`

Program Info Log: `+L+`
`+Y+`
`+Q)}else L!==""?Je("WebGLProgram: Program Info Log:",L):(H===""||Z==="")&&(he=!1);he&&(D.diagnostics={runnable:k,programLog:L,vertexShader:{log:H,prefix:v},fragmentShader:{log:Z,prefix:d}})}s.deleteShader(S),s.deleteShader(C),_=new po(s,g),b=jS(s,g)}let _;this.getUniforms=function(){return _===void 0&&E(this),_};let b;this.getAttributes=function(){return b===void 0&&E(this),b};let U=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return U===!1&&(U=s.getProgramParameter(g,GS)),U},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(g),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=HS++,this.cacheKey=e,this.usedTimes=1,this.program=g,this.vertexShader=S,this.fragmentShader=C,this}var hM=0,uf=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,n){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let n of t)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,n=t.get(e);return n===void 0&&(n=new Set,t.set(e,n)),n}_getShaderStage(e){let t=this.shaderCache,n=t.get(e);return n===void 0&&(n=new ff(e),t.set(e,n)),n}},ff=class{constructor(e){this.id=hM++,this.code=e,this.usedTimes=0}};function uM(i){return i===Hs||i===va||i===ya}function fM(i,e,t,n,s,r){let o=new so,a=new uf,l=new Set,c=[],f=new Map,u=n.logarithmicDepthBuffer,h={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function p(_){return l.add(_),_===0?"uv":`uv${_}`}function g(_,b,U,D,P,z){let V=D.fog,L=P.geometry,H=_.isMeshStandardMaterial||_.isMeshLambertMaterial||_.isMeshPhongMaterial?D.environment:null,Z=_.isMeshStandardMaterial||_.isMeshLambertMaterial&&!_.envMap||_.isMeshPhongMaterial&&!_.envMap,k=e.get(_.envMap||H,Z),he=h[_.type],Y=n.precision;_.precision!==null&&(Y=n.getMaxPrecision(_.precision),Y!==_.precision&&Je("WebGLProgram.getParameters:",_.precision,"not supported, using",Y,"instead."));let Q=L.morphAttributes.position||L.morphAttributes.normal||L.morphAttributes.color,ne=Q!==void 0?Q.length:0,de=0;L.morphAttributes.position!==void 0&&(de=1),L.morphAttributes.normal!==void 0&&(de=2),L.morphAttributes.color!==void 0&&(de=3);let pe,ee,_e,ye;if(he){let Pe=Qi[he];pe=Pe.vertexShader,ee=Pe.fragmentShader}else{pe=_.vertexShader,ee=_.fragmentShader;let Pe=a.getVertexShaderStage(_),at=a.getFragmentShaderStage(_);a.update(_,Pe,at),_e=Pe.id,ye=at.id}let Re=i.getRenderTarget(),we=i.state.buffers.depth.getReversed(),qe=P.isInstancedMesh===!0,rt=P.isBatchedMesh===!0,We=!!_.map,ft=!!_.matcap,lt=!!k,it=lt&&k.isPMREMTexture===!0,Yt=!!_.aoMap,Bt=!!_.lightMap,rn=!!_.bumpMap&&_.wireframe===!1,Dt=!!_.normalMap,An=!!_.displacementMap,St=!!_.emissiveMap,gn=!!_.metalnessMap,Jt=!!_.roughnessMap,on=_.anisotropy>0,O=_.clearcoat>0,Ie=_.diffuseRoughness>0,Ze=_.dispersion>0,ot=_.retroreflectivity>0,Ae=_.iridescence>0,Ut=_.sheen>0,Ge=_.transmission>0,$e=on&&!!_.anisotropyMap,R=O&&!!_.clearcoatMap,M=O&&!!_.clearcoatNormalMap,X=O&&!!_.clearcoatRoughnessMap,fe=Ie&&!!_.diffuseRoughnessMap,le=Ae&&!!_.iridescenceMap,ve=Ae&&!!_.iridescenceThicknessMap,Se=Ut&&!!_.sheenColorMap,ie=Ut&&!!_.sheenRoughnessMap,oe=!!_.specularMap,ge=!!_.specularColorMap,F=!!_.specularIntensityMap,ae=Ge&&!!_.transmissionMap,se=Ge&&!!_.thicknessMap,Te=!!_.gradientMap,xe=!!_.alphaMap,be=_.alphaTest>0,Xe=!!_.alphaHash,je=!!_.extensions,ue=Ki;_.toneMapped&&(Re===null||Re.isXRRenderTarget===!0)&&(ue=i.toneMapping);let ze=it?k.isCompressedCubeTexture?k.image[0].mipmaps:k.mipmaps:null,Qe={shaderID:he,shaderType:_.type,shaderName:_.name,vertexShader:pe,fragmentShader:ee,defines:_.defines,customVertexShaderID:_e,customFragmentShaderID:ye,isRawShaderMaterial:_.isRawShaderMaterial===!0,glslVersion:_.glslVersion,precision:Y,batching:rt,batchingColor:rt&&P._colorsTexture!==null,instancing:qe,instancingColor:qe&&P.instanceColor!==null,instancingMorph:qe&&P.morphTexture!==null,outputColorSpace:Re===null?i.outputColorSpace:Re.isXRRenderTarget===!0?Re.texture.colorSpace:mt.workingColorSpace,alphaToCoverage:!!_.alphaToCoverage,map:We,matcap:ft,envMap:lt,envMapMode:lt&&k.mapping,envMapPMREM:it,envMapMaxLod:it?ze.length-1:null,envMapSize:it?ze[0].width:null,aoMap:Yt,lightMap:Bt,bumpMap:rn,normalMap:Dt,displacementMap:An,emissiveMap:St,normalMapObjectSpace:Dt&&_.normalMapType===kp,normalMapTangentSpace:Dt&&_.normalMapType===Xu,packedNormalMap:Dt&&_.normalMapType===Xu&&uM(_.normalMap.format),metalnessMap:gn,roughnessMap:Jt,anisotropy:on,anisotropyMap:$e,clearcoat:O,clearcoatMap:R,clearcoatNormalMap:M,clearcoatRoughnessMap:X,diffuseRoughness:Ie,diffuseRoughnessMap:fe,dispersion:Ze,retroreflection:ot,iridescence:Ae,iridescenceMap:le,iridescenceThicknessMap:ve,sheen:Ut,sheenColorMap:Se,sheenRoughnessMap:ie,specularMap:oe,specularColorMap:ge,specularIntensityMap:F,transmission:Ge,transmissionMap:ae,thicknessMap:se,gradientMap:Te,opaque:_.transparent===!1&&_.blending===ho&&_.alphaToCoverage===!1,alphaMap:xe,alphaTest:be,alphaHash:Xe,combine:_.combine,mapUv:We&&p(_.map.channel),aoMapUv:Yt&&p(_.aoMap.channel),lightMapUv:Bt&&p(_.lightMap.channel),bumpMapUv:rn&&p(_.bumpMap.channel),normalMapUv:Dt&&p(_.normalMap.channel),displacementMapUv:An&&p(_.displacementMap.channel),emissiveMapUv:St&&p(_.emissiveMap.channel),metalnessMapUv:gn&&p(_.metalnessMap.channel),roughnessMapUv:Jt&&p(_.roughnessMap.channel),anisotropyMapUv:$e&&p(_.anisotropyMap.channel),clearcoatMapUv:R&&p(_.clearcoatMap.channel),clearcoatNormalMapUv:M&&p(_.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:X&&p(_.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:fe&&p(_.diffuseRoughnessMap.channel),iridescenceMapUv:le&&p(_.iridescenceMap.channel),iridescenceThicknessMapUv:ve&&p(_.iridescenceThicknessMap.channel),sheenColorMapUv:Se&&p(_.sheenColorMap.channel),sheenRoughnessMapUv:ie&&p(_.sheenRoughnessMap.channel),specularMapUv:oe&&p(_.specularMap.channel),specularColorMapUv:ge&&p(_.specularColorMap.channel),specularIntensityMapUv:F&&p(_.specularIntensityMap.channel),transmissionMapUv:ae&&p(_.transmissionMap.channel),thicknessMapUv:se&&p(_.thicknessMap.channel),alphaMapUv:xe&&p(_.alphaMap.channel),vertexTangents:!!L.attributes.tangent&&(Dt||on),vertexNormals:!!L.attributes.normal,vertexColors:_.vertexColors,vertexAlphas:_.vertexColors===!0&&!!L.attributes.color&&L.attributes.color.itemSize===4,pointsUvs:P.isPoints===!0&&!!L.attributes.uv&&(We||xe),fog:!!V,useFog:_.fog===!0,fogExp2:!!V&&V.isFogExp2,flatShading:_.wireframe===!1&&(_.flatShading===!0||L.attributes.normal===void 0&&Dt===!1&&(_.isMeshLambertMaterial||_.isMeshPhongMaterial||_.isMeshStandardMaterial||_.isMeshPhysicalMaterial)),sizeAttenuation:_.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:we,skinning:P.isSkinnedMesh===!0,hasPositionAttribute:L.attributes.position!==void 0,morphTargets:L.morphAttributes.position!==void 0,morphNormals:L.morphAttributes.normal!==void 0,morphColors:L.morphAttributes.color!==void 0,morphTargetsCount:ne,morphTextureStride:de,numSunLights:b.sun.length,numDirLights:b.directional.length,numPointLights:b.point.length,numSpotLights:b.spot.length,numSpotLightMaps:b.spotLightMap.length,numRectAreaLights:b.rectArea.length,numHemiLights:b.hemi.length,numSunLightShadows:b.sunShadowMap.length,numDirLightShadows:b.directionalShadowMap.length,numPointLightShadows:b.pointShadowMap.length,numSpotLightShadows:b.spotShadowMap.length,numSpotLightShadowsWithMaps:b.numSpotLightShadowsWithMaps,numLightProbes:b.numLightProbes,numLightProbeGrids:z.filter(Pe=>Pe.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:_.dithering,shadowMapEnabled:i.shadowMap.enabled&&U.length>0,shadowMapType:i.shadowMap.type,toneMapping:ue,decodeVideoTexture:We&&_.map.isVideoTexture===!0&&mt.getTransfer(_.map.colorSpace)===Tt,decodeVideoTextureEmissive:St&&_.emissiveMap.isVideoTexture===!0&&mt.getTransfer(_.emissiveMap.colorSpace)===Tt,premultipliedAlpha:_.premultipliedAlpha,doubleSided:_.side===Si,flipSided:_.side===pn,useDepthPacking:_.depthPacking>=0,depthPacking:_.depthPacking||0,index0AttributeName:_.index0AttributeName,extensionClipCullDistance:je&&_.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(je&&_.extensions.multiDraw===!0||rt)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:_.customProgramCacheKey()};return Qe.vertexUv1s=l.has(1),Qe.vertexUv2s=l.has(2),Qe.vertexUv3s=l.has(3),l.clear(),Qe}function v(_){let b=[];if(_.shaderID?b.push(_.shaderID):(b.push(_.customVertexShaderID),b.push(_.customFragmentShaderID)),_.defines!==void 0)for(let U in _.defines)b.push(U),b.push(_.defines[U]);return _.isRawShaderMaterial===!1&&(d(b,_),m(b,_),b.push(i.outputColorSpace)),b.push(_.customProgramCacheKey),b.join()}function d(_,b){_.push(b.precision),_.push(b.outputColorSpace),_.push(b.envMapMode),_.push(b.envMapPMREM),_.push(b.envMapMaxLod),_.push(b.envMapSize),_.push(b.mapUv),_.push(b.alphaMapUv),_.push(b.lightMapUv),_.push(b.aoMapUv),_.push(b.bumpMapUv),_.push(b.normalMapUv),_.push(b.displacementMapUv),_.push(b.emissiveMapUv),_.push(b.metalnessMapUv),_.push(b.roughnessMapUv),_.push(b.anisotropyMapUv),_.push(b.clearcoatMapUv),_.push(b.clearcoatNormalMapUv),_.push(b.clearcoatRoughnessMapUv),_.push(b.diffuseRoughnessMapUv),_.push(b.iridescenceMapUv),_.push(b.iridescenceThicknessMapUv),_.push(b.sheenColorMapUv),_.push(b.sheenRoughnessMapUv),_.push(b.specularMapUv),_.push(b.specularColorMapUv),_.push(b.specularIntensityMapUv),_.push(b.transmissionMapUv),_.push(b.thicknessMapUv),_.push(b.combine),_.push(b.fogExp2),_.push(b.sizeAttenuation),_.push(b.morphTargetsCount),_.push(b.numSunLights),_.push(b.numDirLights),_.push(b.numPointLights),_.push(b.numSpotLights),_.push(b.numSpotLightMaps),_.push(b.numHemiLights),_.push(b.numRectAreaLights),_.push(b.numSunLightShadows),_.push(b.numDirLightShadows),_.push(b.numPointLightShadows),_.push(b.numSpotLightShadows),_.push(b.numSpotLightShadowsWithMaps),_.push(b.numLightProbes),_.push(b.numLightProbeGrids),_.push(b.shadowMapType),_.push(b.toneMapping),_.push(b.numClippingPlanes),_.push(b.numClipIntersection),_.push(b.depthPacking)}function m(_,b){o.disableAll(),b.instancing&&o.enable(0),b.instancingColor&&o.enable(1),b.instancingMorph&&o.enable(2),b.matcap&&o.enable(3),b.envMap&&o.enable(4),b.normalMapObjectSpace&&o.enable(5),b.normalMapTangentSpace&&o.enable(6),b.clearcoat&&o.enable(7),b.iridescence&&o.enable(8),b.alphaTest&&o.enable(9),b.vertexColors&&o.enable(10),b.vertexAlphas&&o.enable(11),b.vertexUv1s&&o.enable(12),b.vertexUv2s&&o.enable(13),b.vertexUv3s&&o.enable(14),b.vertexTangents&&o.enable(15),b.anisotropy&&o.enable(16),b.alphaHash&&o.enable(17),b.batching&&o.enable(18),b.dispersion&&o.enable(19),b.retroreflection&&o.enable(24),b.diffuseRoughness&&o.enable(25),b.batchingColor&&o.enable(20),b.gradientMap&&o.enable(21),b.packedNormalMap&&o.enable(22),b.vertexNormals&&o.enable(23),_.push(o.mask),o.disableAll(),b.fog&&o.enable(0),b.useFog&&o.enable(1),b.flatShading&&o.enable(2),b.logarithmicDepthBuffer&&o.enable(3),b.reversedDepthBuffer&&o.enable(4),b.skinning&&o.enable(5),b.morphTargets&&o.enable(6),b.morphNormals&&o.enable(7),b.morphColors&&o.enable(8),b.premultipliedAlpha&&o.enable(9),b.shadowMapEnabled&&o.enable(10),b.doubleSided&&o.enable(11),b.flipSided&&o.enable(12),b.useDepthPacking&&o.enable(13),b.dithering&&o.enable(14),b.transmission&&o.enable(15),b.sheen&&o.enable(16),b.opaque&&o.enable(17),b.pointsUvs&&o.enable(18),b.decodeVideoTexture&&o.enable(19),b.decodeVideoTextureEmissive&&o.enable(20),b.alphaToCoverage&&o.enable(21),b.numLightProbeGrids>0&&o.enable(22),b.hasPositionAttribute&&o.enable(23),_.push(o.mask)}function y(_){let b=h[_.type],U;if(b){let D=Qi[b];U=em.clone(D.uniforms)}else U=_.uniforms;return U}function T(_,b){let U=f.get(b);return U!==void 0?++U.usedTimes:(U=new cM(i,b,_,s),c.push(U),f.set(b,U)),U}function S(_){if(--_.usedTimes===0){let b=c.indexOf(_);c[b]=c[c.length-1],c.pop(),f.delete(_.cacheKey),_.destroy()}}function C(_){a.remove(_)}function E(){a.dispose()}return{getParameters:g,getProgramCacheKey:v,getUniforms:y,acquireProgram:T,releaseProgram:S,releaseShaderCache:C,programs:c,dispose:E}}function dM(){let i=new WeakMap;function e(o){return i.has(o)}function t(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:e,get:t,remove:n,update:s,dispose:r}}function pM(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.material.id!==e.material.id?i.material.id-e.material.id:i.materialVariant!==e.materialVariant?i.materialVariant-e.materialVariant:i.z!==e.z?i.z-e.z:i.id-e.id}function ym(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.z!==e.z?e.z-i.z:i.id-e.id}function Sm(){let i=[],e=0,t=[],n=[],s=[];function r(){e=0,t.length=0,n.length=0,s.length=0}function o(h){let p=0;return h.isInstancedMesh&&(p+=2),h.isSkinnedMesh&&(p+=1),p}function a(h,p,g,v,d,m){let y=i[e];return y===void 0?(y={id:h.id,object:h,geometry:p,material:g,materialVariant:o(h),groupOrder:v,renderOrder:h.renderOrder,z:d,group:m},i[e]=y):(y.id=h.id,y.object=h,y.geometry=p,y.material=g,y.materialVariant=o(h),y.groupOrder=v,y.renderOrder=h.renderOrder,y.z=d,y.group=m),e++,y}function l(h,p,g,v,d,m,y){y.reversedDepth===!0&&(d=-d);let T=a(h,p,g,v,d,m);g.transmission>0?n.push(T):g.transparent===!0?s.push(T):t.push(T)}function c(h,p,g,v,d,m){let y=a(h,p,g,v,d,m);g.transmission>0?n.unshift(y):g.transparent===!0?s.unshift(y):t.unshift(y)}function f(h,p){t.length>1&&t.sort(h||pM),n.length>1&&n.sort(p||ym),s.length>1&&s.sort(p||ym)}function u(){for(let h=e,p=i.length;h<p;h++){let g=i[h];if(g.id===null)break;g.id=null,g.object=null,g.geometry=null,g.material=null,g.group=null}}return{opaque:t,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:u,sort:f}}function mM(){let i=new WeakMap;function e(n,s){let r=i.get(n),o;return r===void 0?(o=new Sm,i.set(n,[o])):s>=r.length?(o=new Sm,r.push(o)):o=r[s],o}function t(){i=new WeakMap}return{get:e,dispose:t}}function gM(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new W,color:new ht};break;case"SpotLight":t={position:new W,direction:new W,color:new ht,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new W,color:new ht,distance:0,decay:0};break;case"HemisphereLight":t={direction:new W,skyColor:new ht,groundColor:new ht};break;case"RectAreaLight":t={color:new ht,position:new W,halfWidth:new W,halfHeight:new W};break}return i[e.id]=t,t}}}function _M(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new xt};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new xt};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new xt,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[e.id]=t,t}}}var xM=0;function vM(i,e){return(e.castShadow?2:0)-(i.castShadow?2:0)+(e.map?1:0)-(i.map?1:0)}function yM(i){let e=new gM,t=_M(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new W);let s=new W,r=new It,o=new It;function a(c){let f=0,u=0,h=0;for(let z=0;z<9;z++)n.probe[z].set(0,0,0);let p=0,g=0,v=0,d=0,m=0,y=0,T=0,S=0,C=0,E=0,_=0,b=0,U=0,D=0;c.sort(vM);for(let z=0,V=c.length;z<V;z++){let L=c[z],H=L.color,Z=L.intensity,k=L.distance,he=null;if(L.shadow&&L.shadow.map&&(L.shadow.map.texture.format===Hs?he=L.shadow.map.texture:he=L.shadow.map.depthTexture||L.shadow.map.texture),L.isAmbientLight)f+=H.r*Z,u+=H.g*Z,h+=H.b*Z;else if(L.isLightProbe){for(let Y=0;Y<9;Y++)n.probe[Y].addScaledVector(L.sh.coefficients[Y],Z);D++}else if(L.isSunLight){let Y=e.get(L);if(Y.color.copy(L.color).multiplyScalar(L.intensity),L.castShadow){let Q=L.shadow,ne=t.get(L);ne.shadowIntensity=Q.intensity,ne.shadowBias=Q.bias,ne.shadowNormalBias=Q.normalBias,ne.shadowRadius=Q.radius,ne.shadowMapSize.copy(Q.mapSize).multiply(Q.getFrameExtents()),n.sunShadow[g]=ne,n.sunShadowMap[g]=he;let de=Q.getViewportCount();for(let pe=0;pe<de;pe++)n.sunShadowMatrix[v+pe]=Q.getMatrix(pe),n.sunShadowCascade[v+pe]=Q._cascadeData[pe];v+=de,g++}n.sun[p]=Y,p++}else if(L.isDirectionalLight){let Y=e.get(L);if(Y.color.copy(L.color).multiplyScalar(L.intensity),L.castShadow){let Q=L.shadow,ne=t.get(L);ne.shadowIntensity=Q.intensity,ne.shadowBias=Q.bias,ne.shadowNormalBias=Q.normalBias,ne.shadowRadius=Q.radius,ne.shadowMapSize=Q.mapSize,n.directionalShadow[d]=ne,n.directionalShadowMap[d]=he,n.directionalShadowMatrix[d]=L.shadow.matrix,C++}n.directional[d]=Y,d++}else if(L.isSpotLight){let Y=e.get(L);Y.position.setFromMatrixPosition(L.matrixWorld),Y.color.copy(H).multiplyScalar(Z),Y.distance=k,Y.coneCos=Math.cos(L.angle),Y.penumbraCos=Math.cos(L.angle*(1-L.penumbra)),Y.decay=L.decay,n.spot[y]=Y;let Q=L.shadow;if(L.map&&(n.spotLightMap[b]=L.map,b++,Q.updateMatrices(L),L.castShadow&&U++),n.spotLightMatrix[y]=Q.matrix,L.castShadow){let ne=t.get(L);ne.shadowIntensity=Q.intensity,ne.shadowBias=Q.bias,ne.shadowNormalBias=Q.normalBias,ne.shadowRadius=Q.radius,ne.shadowMapSize=Q.mapSize,n.spotShadow[y]=ne,n.spotShadowMap[y]=he,_++}y++}else if(L.isRectAreaLight){let Y=e.get(L);Y.color.copy(H).multiplyScalar(Z),Y.halfWidth.set(L.width*.5,0,0),Y.halfHeight.set(0,L.height*.5,0),n.rectArea[T]=Y,T++}else if(L.isPointLight){let Y=e.get(L);if(Y.color.copy(L.color).multiplyScalar(L.intensity),Y.distance=L.distance,Y.decay=L.decay,L.castShadow){let Q=L.shadow,ne=t.get(L);ne.shadowIntensity=Q.intensity,ne.shadowBias=Q.bias,ne.shadowNormalBias=Q.normalBias,ne.shadowRadius=Q.radius,ne.shadowMapSize=Q.mapSize,ne.shadowCameraNear=Q.camera.near,ne.shadowCameraFar=Q.camera.far,n.pointShadow[m]=ne,n.pointShadowMap[m]=he,n.pointShadowMatrix[m]=L.shadow.matrix,E++}n.point[m]=Y,m++}else if(L.isHemisphereLight){let Y=e.get(L);Y.skyColor.copy(L.color).multiplyScalar(Z),Y.groundColor.copy(L.groundColor).multiplyScalar(Z),n.hemi[S]=Y,S++}}T>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=Ne.LTC_FLOAT_1,n.rectAreaLTC2=Ne.LTC_FLOAT_2):(n.rectAreaLTC1=Ne.LTC_HALF_1,n.rectAreaLTC2=Ne.LTC_HALF_2)),n.ambient[0]=f,n.ambient[1]=u,n.ambient[2]=h;let P=n.hash;(P.sunLength!==p||P.directionalLength!==d||P.pointLength!==m||P.spotLength!==y||P.rectAreaLength!==T||P.hemiLength!==S||P.numSunShadows!==g||P.numDirectionalShadows!==C||P.numPointShadows!==E||P.numSpotShadows!==_||P.numSpotMaps!==b||P.numLightProbes!==D)&&(n.sun.length=p,n.directional.length=d,n.spot.length=y,n.rectArea.length=T,n.point.length=m,n.hemi.length=S,n.sunShadow.length=g,n.sunShadowMap.length=g,n.sunShadowMatrix.length=v,n.sunShadowCascade.length=v,n.directionalShadow.length=C,n.directionalShadowMap.length=C,n.directionalShadowMatrix.length=C,n.pointShadow.length=E,n.pointShadowMap.length=E,n.pointShadowMatrix.length=E,n.spotShadow.length=_,n.spotShadowMap.length=_,n.spotLightMatrix.length=_+b-U,n.spotLightMap.length=b,n.numSpotLightShadowsWithMaps=U,n.numLightProbes=D,P.sunLength=p,P.directionalLength=d,P.pointLength=m,P.spotLength=y,P.rectAreaLength=T,P.hemiLength=S,P.numSunShadows=g,P.numDirectionalShadows=C,P.numPointShadows=E,P.numSpotShadows=_,P.numSpotMaps=b,P.numLightProbes=D,n.version=xM++)}function l(c,f){let u=0,h=0,p=0,g=0,v=0,d=0,m=f.matrixWorldInverse;for(let y=0,T=c.length;y<T;y++){let S=c[y];if(S.isSunLight){let C=n.sun[u];C.direction.setFromMatrixPosition(S.matrixWorld),C.direction.transformDirection(m),u++}else if(S.isDirectionalLight){let C=n.directional[h];C.direction.setFromMatrixPosition(S.matrixWorld),s.setFromMatrixPosition(S.target.matrixWorld),C.direction.sub(s),C.direction.transformDirection(m),h++}else if(S.isSpotLight){let C=n.spot[g];C.position.setFromMatrixPosition(S.matrixWorld),C.position.applyMatrix4(m),C.direction.setFromMatrixPosition(S.matrixWorld),s.setFromMatrixPosition(S.target.matrixWorld),C.direction.sub(s),C.direction.transformDirection(m),g++}else if(S.isRectAreaLight){let C=n.rectArea[v];C.position.setFromMatrixPosition(S.matrixWorld),C.position.applyMatrix4(m),o.identity(),r.copy(S.matrixWorld),r.premultiply(m),o.extractRotation(r),C.halfWidth.set(S.width*.5,0,0),C.halfHeight.set(0,S.height*.5,0),C.halfWidth.applyMatrix4(o),C.halfHeight.applyMatrix4(o),v++}else if(S.isPointLight){let C=n.point[p];C.position.setFromMatrixPosition(S.matrixWorld),C.position.applyMatrix4(m),p++}else if(S.isHemisphereLight){let C=n.hemi[d];C.direction.setFromMatrixPosition(S.matrixWorld),C.direction.transformDirection(m),d++}}}return{setup:a,setupView:l,state:n}}function Mm(i){let e=new yM(i),t=[],n=[],s=[];function r(u){f.camera=u,t.length=0,n.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):t.push(u)}function a(u){n.push(u)}function l(){e.setup(t),s.sort((u,h)=>u.priority-h.priority||u.id-h.id)}function c(u){e.setupView(t,u)}let f={lightsArray:t,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:f,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function SM(i){let e=new WeakMap;function t(s,r=0){let o=e.get(s),a;return o===void 0?(a=new Mm(i),e.set(s,[a])):r>=o.length?(a=new Mm(i),o.push(a)):a=o[r],a}function n(){e=new WeakMap}return{get:t,dispose:n}}var MM=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,bM=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,wM=[new W(1,0,0),new W(-1,0,0),new W(0,1,0),new W(0,-1,0),new W(0,0,1),new W(0,0,-1)],AM=[new W(0,-1,0),new W(0,-1,0),new W(0,0,1),new W(0,0,-1),new W(0,-1,0),new W(0,-1,0)],bm=new It,Sa=new W,of=new W;function TM(i,e,t){let n=new ar,s=new xt,r=new xt,o=new Lt,a=new Gl,l=new Hl,c={},f=t.maxTextureSize,u={[yi]:pn,[pn]:yi,[Si]:Si},h=new Ji({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new xt},radius:{value:4}},vertexShader:MM,fragmentShader:bM}),p=h.clone();p.defines.HORIZONTAL_PASS=1;let g=new xn;g.setAttribute("position",new Xt(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let v=new vn(g,h),d=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=fa;let m=this.type;this.render=function(E,_,b){if(d.enabled===!1||d.autoUpdate===!1&&d.needsUpdate===!1||E.length===0)return;this.type===_p&&(Je("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=fa);let U=i.getRenderTarget(),D=i.getActiveCubeFace(),P=i.getActiveMipmapLevel(),z=i.state;z.setBlending(cr),z.buffers.depth.getReversed()===!0?z.buffers.color.setClear(0,0,0,0):z.buffers.color.setClear(1,1,1,1),z.buffers.depth.setTest(!0),z.setScissorTest(!1);let V=m!==this.type;V&&_.traverse(function(L){L.material&&(Array.isArray(L.material)?L.material.forEach(H=>H.needsUpdate=!0):L.material.needsUpdate=!0)});for(let L=0,H=E.length;L<H;L++){let Z=E[L],k=Z.shadow;if(k===void 0){Je("WebGLShadowMap:",Z,"has no shadow.");continue}if(k.autoUpdate===!1&&k.needsUpdate===!1)continue;s.copy(k.mapSize);let he=k.getFrameExtents();s.multiply(he),r.copy(k.mapSize),(s.x>f||s.y>f)&&(s.x>f&&(r.x=Math.floor(f/he.x),s.x=r.x*he.x,k.mapSize.x=r.x),s.y>f&&(r.y=Math.floor(f/he.y),s.y=r.y*he.y,k.mapSize.y=r.y));let Y=i.state.buffers.depth.getReversed();if(k.camera._reversedDepth=Y,k.map===null||V===!0){if(k.map!==null&&(k.map.depthTexture!==null&&(k.map.depthTexture.dispose(),k.map.depthTexture=null),k.map.dispose()),this.type===co){if(Z.isPointLight){Je("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}k.map=new ri(s.x,s.y,{format:Hs,type:Ui,minFilter:dn,magFilter:dn,generateMipmaps:!1}),k.map.texture.name=Z.name+".shadowMap",k.map.depthTexture=new xs(s.x,s.y,Ni),k.map.depthTexture.name=Z.name+".shadowMapDepth",k.map.depthTexture.format=gs,k.map.depthTexture.compareFunction=null,k.map.depthTexture.minFilter=fn,k.map.depthTexture.magFilter=fn}else Z.isPointLight?(k.map=new ba(s.x),k.map.depthTexture=new ra(s.x,Di)):(k.map=new ri(s.x,s.y),k.map.depthTexture=new xs(s.x,s.y,Di)),k.map.depthTexture.name=Z.name+".shadowMap",k.map.depthTexture.format=gs,this.type===fa?(k.map.depthTexture.compareFunction=Y?Ju:Zu,k.map.depthTexture.minFilter=dn,k.map.depthTexture.magFilter=dn):(k.map.depthTexture.compareFunction=null,k.map.depthTexture.minFilter=fn,k.map.depthTexture.magFilter=fn);k.camera.updateProjectionMatrix()}k.map.isWebGLCubeRenderTarget!==!0&&(k.map.width!==s.x||k.map.height!==s.y)&&k.map.setSize(s.x,s.y);let Q=k.map.isWebGLCubeRenderTarget?6:k.getViewportCount();Z.isPointLight!==!0&&k.updateMatrices(Z,b);let ne=(k.camera.layers.mask&4294967294)!==0?k.camera.layers:b.layers;for(let de=0;de<Q;de++){let pe=k.getCamera(de);if(Z.isPointLight){let ee=k.camera,_e=k.matrix,ye=Z.distance||ee.far;ye!==ee.far&&(ee.far=ye,ee.updateProjectionMatrix()),Sa.setFromMatrixPosition(Z.matrixWorld),ee.position.copy(Sa),of.copy(ee.position),of.add(wM[de]),ee.up.copy(AM[de]),ee.lookAt(of),ee.updateMatrixWorld(),_e.makeTranslation(-Sa.x,-Sa.y,-Sa.z),bm.multiplyMatrices(ee.projectionMatrix,ee.matrixWorldInverse),k._frustum.setFromProjectionMatrix(bm,ee.coordinateSystem,ee.reversedDepth)}if(k.map.isWebGLCubeRenderTarget)i.setRenderTarget(k.map,de),i.clear();else{de===0&&(i.setRenderTarget(k.map),i.clear());let ee=k.getViewport(de);o.set(r.x*ee.x,r.y*ee.y,r.x*ee.z,r.y*ee.w),z.viewport(o)}n=k.getFrustum(de),S(_,b,pe,Z,ne,this.type)}k.isPointLightShadow!==!0&&this.type===co&&y(k,b),k.needsUpdate=!1}m=this.type,d.needsUpdate=!1,i.setRenderTarget(U,D,P)};function y(E,_){let b=e.update(v);h.defines.VSM_SAMPLES!==E.blurSamples&&(h.defines.VSM_SAMPLES=E.blurSamples,p.defines.VSM_SAMPLES=E.blurSamples,h.needsUpdate=!0,p.needsUpdate=!0),E.mapPass===null?E.mapPass=new ri(s.x,s.y,{format:Hs,type:Ui}):(E.mapPass.width!==E.map.width||E.mapPass.height!==E.map.height)&&E.mapPass.setSize(E.map.width,E.map.height),h.uniforms.shadow_pass.value=E.map.depthTexture,h.uniforms.resolution.value.set(E.map.width,E.map.height),h.uniforms.radius.value=E.radius,i.setRenderTarget(E.mapPass),i.clear(),i.renderBufferDirect(_,null,b,h,v,null),p.uniforms.shadow_pass.value=E.mapPass.texture,p.uniforms.resolution.value.set(E.map.width,E.map.height),p.uniforms.radius.value=E.radius,i.setRenderTarget(E.map),i.clear(),i.renderBufferDirect(_,null,b,p,v,null)}function T(E,_,b,U){let D=null,P=b.isPointLight===!0?E.customDistanceMaterial:E.customDepthMaterial;if(P!==void 0)D=P;else if(D=b.isPointLight===!0?l:a,i.localClippingEnabled&&_.clipShadows===!0&&Array.isArray(_.clippingPlanes)&&_.clippingPlanes.length!==0||_.displacementMap&&_.displacementScale!==0||_.alphaMap&&_.alphaTest>0||_.map&&_.alphaTest>0||_.alphaToCoverage===!0){let z=D.uuid,V=_.uuid,L=c[z];L===void 0&&(L={},c[z]=L);let H=L[V];H===void 0&&(H=D.clone(),L[V]=H,_.addEventListener("dispose",C)),D=H}if(D.visible=_.visible,D.wireframe=_.wireframe,U===co?D.side=_.shadowSide!==null?_.shadowSide:_.side:D.side=_.shadowSide!==null?_.shadowSide:u[_.side],D.alphaMap=_.alphaMap,D.alphaTest=_.alphaToCoverage===!0?.5:_.alphaTest,D.map=_.map,D.clipShadows=_.clipShadows,D.clippingPlanes=_.clippingPlanes,D.clipIntersection=_.clipIntersection,D.displacementMap=_.displacementMap,D.displacementScale=_.displacementScale,D.displacementBias=_.displacementBias,D.wireframeLinewidth=_.wireframeLinewidth,D.linewidth=_.linewidth,b.isPointLight===!0&&D.isMeshDistanceMaterial===!0){let z=i.properties.get(D);z.light=b}return D}function S(E,_,b,U,D,P){if(E.visible===!1)return;if(E.layers.test(D)&&(E.isMesh||E.isLine||E.isPoints)&&(E.castShadow||E.receiveShadow&&P===co)&&(!E.frustumCulled||E.intersectsFrustum(n))){E.modelViewMatrix.multiplyMatrices(b.matrixWorldInverse,E.matrixWorld);let L=e.update(E),H=E.material;if(Array.isArray(H)){let Z=L.groups;for(let k=0,he=Z.length;k<he;k++){let Y=Z[k],Q=H[Y.materialIndex];if(Q&&Q.visible){let ne=T(E,Q,U,P);E.onBeforeShadow(i,E,_,b,L,ne,Y),i.renderBufferDirect(b,null,L,ne,E,Y),E.onAfterShadow(i,E,_,b,L,ne,Y)}}}else if(H.visible){let Z=T(E,H,U,P);E.onBeforeShadow(i,E,_,b,L,Z,null),i.renderBufferDirect(b,null,L,Z,E,null),E.onAfterShadow(i,E,_,b,L,Z,null)}}let V=E.children;for(let L=0,H=V.length;L<H;L++)S(V[L],_,b,U,D,P)}function C(E){E.target.removeEventListener("dispose",C);for(let b in c){let U=c[b],D=E.target.uuid;D in U&&(U[D].dispose(),delete U[D])}}}function EM(i,e){function t(){let F=!1,ae=new Lt,se=null,Te=new Lt(0,0,0,0);return{setMask:function(xe){se!==xe&&!F&&(i.colorMask(xe,xe,xe,xe),se=xe)},setLocked:function(xe){F=xe},setClear:function(xe,be,Xe,je,ue){ue===!0&&(xe*=je,be*=je,Xe*=je),ae.set(xe,be,Xe,je),Te.equals(ae)===!1&&(i.clearColor(xe,be,Xe,je),Te.copy(ae))},reset:function(){F=!1,se=null,Te.set(-1,0,0,0)}}}function n(){let F=!1,ae=!1,se=null,Te=null,xe=null;return{setReversed:function(be){if(ae!==be){let Xe=e.get("EXT_clip_control");be?Xe.clipControlEXT(Xe.LOWER_LEFT_EXT,Xe.ZERO_TO_ONE_EXT):Xe.clipControlEXT(Xe.LOWER_LEFT_EXT,Xe.NEGATIVE_ONE_TO_ONE_EXT),ae=be;let je=xe;xe=null,this.setClear(je)}},getReversed:function(){return ae},setTest:function(be){be?we(i.DEPTH_TEST):qe(i.DEPTH_TEST)},setMask:function(be){se!==be&&!F&&(i.depthMask(be),se=be)},setFunc:function(be){if(ae&&(be=Zp[be]),Te!==be){switch(be){case Sl:i.depthFunc(i.NEVER);break;case Ml:i.depthFunc(i.ALWAYS);break;case bl:i.depthFunc(i.LESS);break;case eo:i.depthFunc(i.LEQUAL);break;case wl:i.depthFunc(i.EQUAL);break;case Al:i.depthFunc(i.GEQUAL);break;case Tl:i.depthFunc(i.GREATER);break;case El:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}Te=be}},setLocked:function(be){F=be},setClear:function(be){xe!==be&&(xe=be,ae&&(be=1-be),i.clearDepth(be))},reset:function(){F=!1,se=null,Te=null,xe=null,ae=!1}}}function s(){let F=!1,ae=null,se=null,Te=null,xe=null,be=null,Xe=null,je=null,ue=null;return{setTest:function(ze){F||(ze?we(i.STENCIL_TEST):qe(i.STENCIL_TEST))},setMask:function(ze){ae!==ze&&!F&&(i.stencilMask(ze),ae=ze)},setFunc:function(ze,Qe,Pe){(se!==ze||Te!==Qe||xe!==Pe)&&(i.stencilFunc(ze,Qe,Pe),se=ze,Te=Qe,xe=Pe)},setOp:function(ze,Qe,Pe){(be!==ze||Xe!==Qe||je!==Pe)&&(i.stencilOp(ze,Qe,Pe),be=ze,Xe=Qe,je=Pe)},setLocked:function(ze){F=ze},setClear:function(ze){ue!==ze&&(i.clearStencil(ze),ue=ze)},reset:function(){F=!1,ae=null,se=null,Te=null,xe=null,be=null,Xe=null,je=null,ue=null}}}let r=new t,o=new n,a=new s,l={},c=new WeakMap,f={},u={},h={},p=new WeakMap,g=[],v=null,d=!1,m=null,y=null,T=null,S=null,C=null,E=null,_=null,b=new ht(0,0,0),U=0,D=!1,P=null,z=null,V=null,L=null,H=null,Z=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),k=!1,he=0,Y=i.getParameter(i.VERSION);Y.indexOf("WebGL")!==-1?(he=parseFloat(/^WebGL (\d)/.exec(Y)[1]),k=he>=1):Y.indexOf("OpenGL ES")!==-1&&(he=parseFloat(/^OpenGL ES (\d)/.exec(Y)[1]),k=he>=2);let Q=null,ne={},de=i.getParameter(i.SCISSOR_BOX),pe=i.getParameter(i.VIEWPORT),ee=new Lt().fromArray(de),_e=new Lt().fromArray(pe);function ye(F,ae,se,Te){let xe=new Uint8Array(4),be=i.createTexture();i.bindTexture(F,be),i.texParameteri(F,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(F,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Xe=0;Xe<se;Xe++)F===i.TEXTURE_3D||F===i.TEXTURE_2D_ARRAY?i.texImage3D(ae,0,i.RGBA,1,1,Te,0,i.RGBA,i.UNSIGNED_BYTE,xe):i.texImage2D(ae+Xe,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,xe);return be}let Re={};Re[i.TEXTURE_2D]=ye(i.TEXTURE_2D,i.TEXTURE_2D,1),Re[i.TEXTURE_CUBE_MAP]=ye(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Re[i.TEXTURE_2D_ARRAY]=ye(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Re[i.TEXTURE_3D]=ye(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),we(i.DEPTH_TEST),o.setFunc(eo),rn(!1),Dt(wu),we(i.CULL_FACE),Yt(cr);function we(F){f[F]!==!0&&(i.enable(F),f[F]=!0)}function qe(F){f[F]!==!1&&(i.disable(F),f[F]=!1)}function rt(F,ae){return h[F]!==ae?(i.bindFramebuffer(F,ae),h[F]=ae,F===i.DRAW_FRAMEBUFFER&&(h[i.FRAMEBUFFER]=ae),F===i.FRAMEBUFFER&&(h[i.DRAW_FRAMEBUFFER]=ae),!0):!1}function We(F,ae){let se=g,Te=!1;if(F){se=p.get(ae),se===void 0&&(se=[],p.set(ae,se));let xe=F.textures;if(se.length!==xe.length||se[0]!==i.COLOR_ATTACHMENT0){for(let be=0,Xe=xe.length;be<Xe;be++)se[be]=i.COLOR_ATTACHMENT0+be;se.length=xe.length,Te=!0}}else se[0]!==i.BACK&&(se[0]=i.BACK,Te=!0);Te&&i.drawBuffers(se)}function ft(F){return v!==F?(i.useProgram(F),v=F,!0):!1}let lt={[hr]:i.FUNC_ADD,[vp]:i.FUNC_SUBTRACT,[yp]:i.FUNC_REVERSE_SUBTRACT};lt[Sp]=i.MIN,lt[Mp]=i.MAX;let it={[bp]:i.ZERO,[wp]:i.ONE,[Ap]:i.SRC_COLOR,[Cu]:i.SRC_ALPHA,[Ip]:i.SRC_ALPHA_SATURATE,[Rp]:i.DST_COLOR,[Ep]:i.DST_ALPHA,[Tp]:i.ONE_MINUS_SRC_COLOR,[Ru]:i.ONE_MINUS_SRC_ALPHA,[Pp]:i.ONE_MINUS_DST_COLOR,[Cp]:i.ONE_MINUS_DST_ALPHA,[Lp]:i.CONSTANT_COLOR,[Dp]:i.ONE_MINUS_CONSTANT_COLOR,[Np]:i.CONSTANT_ALPHA,[Up]:i.ONE_MINUS_CONSTANT_ALPHA};function Yt(F,ae,se,Te,xe,be,Xe,je,ue,ze){if(F===cr){d===!0&&(qe(i.BLEND),d=!1);return}if(d===!1&&(we(i.BLEND),d=!0),F!==xp){if(F!==m||ze!==D){if((y!==hr||C!==hr)&&(i.blendEquation(i.FUNC_ADD),y=hr,C=hr),ze)switch(F){case ho:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Au:i.blendFunc(i.ONE,i.ONE);break;case Tu:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Eu:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:et("WebGLState: Invalid blending: ",F);break}else switch(F){case ho:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Au:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case Tu:et("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Eu:et("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:et("WebGLState: Invalid blending: ",F);break}T=null,S=null,E=null,_=null,b.set(0,0,0),U=0,m=F,D=ze}return}xe=xe||ae,be=be||se,Xe=Xe||Te,(ae!==y||xe!==C)&&(i.blendEquationSeparate(lt[ae],lt[xe]),y=ae,C=xe),(se!==T||Te!==S||be!==E||Xe!==_)&&(i.blendFuncSeparate(it[se],it[Te],it[be],it[Xe]),T=se,S=Te,E=be,_=Xe),(je.equals(b)===!1||ue!==U)&&(i.blendColor(je.r,je.g,je.b,ue),b.copy(je),U=ue),m=F,D=!1}function Bt(F,ae){F.side===Si?qe(i.CULL_FACE):we(i.CULL_FACE);let se=F.side===pn;ae&&(se=!se),rn(se),F.blending===ho&&F.transparent===!1?Yt(cr):Yt(F.blending,F.blendEquation,F.blendSrc,F.blendDst,F.blendEquationAlpha,F.blendSrcAlpha,F.blendDstAlpha,F.blendColor,F.blendAlpha,F.premultipliedAlpha),o.setFunc(F.depthFunc),o.setTest(F.depthTest),o.setMask(F.depthWrite),r.setMask(F.colorWrite);let Te=F.stencilWrite;a.setTest(Te),Te&&(a.setMask(F.stencilWriteMask),a.setFunc(F.stencilFunc,F.stencilRef,F.stencilFuncMask),a.setOp(F.stencilFail,F.stencilZFail,F.stencilZPass)),St(F.polygonOffset,F.polygonOffsetFactor,F.polygonOffsetUnits),F.alphaToCoverage===!0?we(i.SAMPLE_ALPHA_TO_COVERAGE):qe(i.SAMPLE_ALPHA_TO_COVERAGE)}function rn(F){P!==F&&(F?i.frontFace(i.CW):i.frontFace(i.CCW),P=F)}function Dt(F){F!==mp?(we(i.CULL_FACE),F!==z&&(F===wu?i.cullFace(i.BACK):F===gp?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):qe(i.CULL_FACE),z=F}function An(F){F!==V&&(k&&i.lineWidth(F),V=F)}function St(F,ae,se){F?(we(i.POLYGON_OFFSET_FILL),(L!==ae||H!==se)&&(L=ae,H=se,o.getReversed()&&(ae=-ae,se=-se),i.polygonOffset(ae,se))):qe(i.POLYGON_OFFSET_FILL)}function gn(F){F?we(i.SCISSOR_TEST):qe(i.SCISSOR_TEST)}function Jt(F){F===void 0&&(F=i.TEXTURE0+Z-1),Q!==F&&(i.activeTexture(F),Q=F)}function on(F,ae,se){se===void 0&&(Q===null?se=i.TEXTURE0+Z-1:se=Q);let Te=ne[se];Te===void 0&&(Te={type:void 0,texture:void 0},ne[se]=Te),(Te.type!==F||Te.texture!==ae)&&(Q!==se&&(i.activeTexture(se),Q=se),i.bindTexture(F,ae||Re[F]),Te.type=F,Te.texture=ae)}function O(){let F=ne[Q];F!==void 0&&F.type!==void 0&&(i.bindTexture(F.type,null),F.type=void 0,F.texture=void 0)}function Ie(){try{i.compressedTexImage2D(...arguments)}catch(F){et("WebGLState:",F)}}function Ze(){try{i.compressedTexImage3D(...arguments)}catch(F){et("WebGLState:",F)}}function ot(){try{i.texSubImage2D(...arguments)}catch(F){et("WebGLState:",F)}}function Ae(){try{i.texSubImage3D(...arguments)}catch(F){et("WebGLState:",F)}}function Ut(){try{i.compressedTexSubImage2D(...arguments)}catch(F){et("WebGLState:",F)}}function Ge(){try{i.compressedTexSubImage3D(...arguments)}catch(F){et("WebGLState:",F)}}function $e(){try{i.texStorage2D(...arguments)}catch(F){et("WebGLState:",F)}}function R(){try{i.texStorage3D(...arguments)}catch(F){et("WebGLState:",F)}}function M(){try{i.texImage2D(...arguments)}catch(F){et("WebGLState:",F)}}function X(){try{i.texImage3D(...arguments)}catch(F){et("WebGLState:",F)}}function fe(F){return u[F]!==void 0?u[F]:i.getParameter(F)}function le(F,ae){u[F]!==ae&&(i.pixelStorei(F,ae),u[F]=ae)}function ve(F){ee.equals(F)===!1&&(i.scissor(F.x,F.y,F.z,F.w),ee.copy(F))}function Se(F){_e.equals(F)===!1&&(i.viewport(F.x,F.y,F.z,F.w),_e.copy(F))}function ie(F,ae){let se=c.get(ae);se===void 0&&(se=new WeakMap,c.set(ae,se));let Te=se.get(F);Te===void 0&&(Te=i.getUniformBlockIndex(ae,F.name),i.uniformBlockBinding(ae,Te,Te),se.set(F,Te))}function oe(F,ae,se){let xe=c.get(ae).get(F);l[xe]!==se&&(i.bindBufferBase(i.UNIFORM_BUFFER,xe,se),l[xe]=se)}function ge(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),f={},u={},Q=null,ne={},h={},l={},p=new WeakMap,g=[],v=null,d=!1,m=null,y=null,T=null,S=null,C=null,E=null,_=null,b=new ht(0,0,0),U=0,D=!1,P=null,z=null,V=null,L=null,H=null,ee.set(0,0,i.canvas.width,i.canvas.height),_e.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:we,disable:qe,bindFramebuffer:rt,drawBuffers:We,useProgram:ft,setBlending:Yt,setMaterial:Bt,setFlipSided:rn,setCullFace:Dt,setLineWidth:An,setPolygonOffset:St,setScissorTest:gn,activeTexture:Jt,bindTexture:on,unbindTexture:O,compressedTexImage2D:Ie,compressedTexImage3D:Ze,texImage2D:M,texImage3D:X,pixelStorei:le,getParameter:fe,updateUBOMapping:ie,uniformBlockBinding:oe,texStorage2D:$e,texStorage3D:R,texSubImage2D:ot,texSubImage3D:Ae,compressedTexSubImage2D:Ut,compressedTexSubImage3D:Ge,scissor:ve,viewport:Se,reset:ge}}function CM(i,e,t,n,s,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new xt,f=new WeakMap,u=new Set,h,p=new WeakMap,g=new Set,v=new FinalizationRegistry(R=>g.delete(R)),d=!1;try{d=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function m(R,M){return d?new OffscreenCanvas(R,M):Ko("canvas")}function y(R,M,X){let fe=1,le=$e(R);if((le.width>X||le.height>X)&&(fe=X/Math.max(le.width,le.height)),fe<1)if(typeof HTMLImageElement<"u"&&R instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&R instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&R instanceof ImageBitmap||typeof VideoFrame<"u"&&R instanceof VideoFrame){let ve=Math.floor(fe*le.width),Se=Math.floor(fe*le.height);h===void 0&&(h=m(ve,Se));let ie=M?m(ve,Se):h;return ie.width=ve,ie.height=Se,ie.getContext("2d").drawImage(R,0,0,ve,Se),Je("WebGLRenderer: Texture has been resized from ("+le.width+"x"+le.height+") to ("+ve+"x"+Se+")."),ie}else return"data"in R&&Je("WebGLRenderer: Image in DataTexture is too big ("+le.width+"x"+le.height+")."),R;return R}function T(R){return R.generateMipmaps}function S(R){i.generateMipmap(R)}function C(R){return R.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:R.isWebGL3DRenderTarget?i.TEXTURE_3D:R.isWebGLArrayRenderTarget||R.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function E(R,M,X,fe,le,ve=!1){if(R!==null){if(i[R]!==void 0)return i[R];Je("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+R+"'")}let Se;fe&&(Se=e.get("EXT_texture_norm16"),Se||Je("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let ie=M;if(M===i.RED&&(X===i.FLOAT&&(ie=i.R32F),X===i.HALF_FLOAT&&(ie=i.R16F),X===i.UNSIGNED_BYTE&&(ie=i.R8),X===i.UNSIGNED_SHORT&&Se&&(ie=Se.R16_EXT),X===i.SHORT&&Se&&(ie=Se.R16_SNORM_EXT)),M===i.RED_INTEGER&&(X===i.UNSIGNED_BYTE&&(ie=i.R8UI),X===i.UNSIGNED_SHORT&&(ie=i.R16UI),X===i.UNSIGNED_INT&&(ie=i.R32UI),X===i.BYTE&&(ie=i.R8I),X===i.SHORT&&(ie=i.R16I),X===i.INT&&(ie=i.R32I)),M===i.RG&&(X===i.FLOAT&&(ie=i.RG32F),X===i.HALF_FLOAT&&(ie=i.RG16F),X===i.UNSIGNED_BYTE&&(ie=i.RG8),X===i.UNSIGNED_SHORT&&Se&&(ie=Se.RG16_EXT),X===i.SHORT&&Se&&(ie=Se.RG16_SNORM_EXT)),M===i.RG_INTEGER&&(X===i.UNSIGNED_BYTE&&(ie=i.RG8UI),X===i.UNSIGNED_SHORT&&(ie=i.RG16UI),X===i.UNSIGNED_INT&&(ie=i.RG32UI),X===i.BYTE&&(ie=i.RG8I),X===i.SHORT&&(ie=i.RG16I),X===i.INT&&(ie=i.RG32I)),M===i.RGB_INTEGER&&(X===i.UNSIGNED_BYTE&&(ie=i.RGB8UI),X===i.UNSIGNED_SHORT&&(ie=i.RGB16UI),X===i.UNSIGNED_INT&&(ie=i.RGB32UI),X===i.BYTE&&(ie=i.RGB8I),X===i.SHORT&&(ie=i.RGB16I),X===i.INT&&(ie=i.RGB32I)),M===i.RGBA_INTEGER&&(X===i.UNSIGNED_BYTE&&(ie=i.RGBA8UI),X===i.UNSIGNED_SHORT&&(ie=i.RGBA16UI),X===i.UNSIGNED_INT&&(ie=i.RGBA32UI),X===i.BYTE&&(ie=i.RGBA8I),X===i.SHORT&&(ie=i.RGBA16I),X===i.INT&&(ie=i.RGBA32I)),M===i.RGB&&(X===i.UNSIGNED_SHORT&&Se&&(ie=Se.RGB16_EXT),X===i.SHORT&&Se&&(ie=Se.RGB16_SNORM_EXT),X===i.UNSIGNED_INT_5_9_9_9_REV&&(ie=i.RGB9_E5),X===i.UNSIGNED_INT_10F_11F_11F_REV&&(ie=i.R11F_G11F_B10F)),M===i.RGBA){let oe=ve?Zo:mt.getTransfer(le);X===i.FLOAT&&(ie=i.RGBA32F),X===i.HALF_FLOAT&&(ie=i.RGBA16F),X===i.UNSIGNED_BYTE&&(ie=oe===Tt?i.SRGB8_ALPHA8:i.RGBA8),X===i.UNSIGNED_SHORT&&Se&&(ie=Se.RGBA16_EXT),X===i.SHORT&&Se&&(ie=Se.RGBA16_SNORM_EXT),X===i.UNSIGNED_SHORT_4_4_4_4&&(ie=i.RGBA4),X===i.UNSIGNED_SHORT_5_5_5_1&&(ie=i.RGB5_A1)}return(ie===i.R16F||ie===i.R32F||ie===i.RG16F||ie===i.RG32F||ie===i.RGBA16F||ie===i.RGBA32F)&&e.get("EXT_color_buffer_float"),ie}function _(R,M){let X;return R?M===null||M===Di||M===fr?X=i.DEPTH24_STENCIL8:M===Ni?X=i.DEPTH32F_STENCIL8:M===fo&&(X=i.DEPTH24_STENCIL8,Je("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):M===null||M===Di||M===fr?X=i.DEPTH_COMPONENT24:M===Ni?X=i.DEPTH_COMPONENT32F:M===fo&&(X=i.DEPTH_COMPONENT16),X}function b(R,M){return T(R)===!0||R.isFramebufferTexture&&R.minFilter!==fn&&R.minFilter!==dn?Math.log2(Math.max(M.width,M.height))+1:R.mipmaps.length>0?R.mipmaps.length:R.isCompressedTexture&&Array.isArray(R.image)?M.mipmaps.length:1}function U(R){let M=new WeakRef(R);n.get(R).__ref=M,g.add(M),v.register(R,M,M)}function D(R){let M=n.get(R).__ref;M!==void 0&&(g.delete(M),v.unregister(M))}function P(R){V(R.target)}function z(R){L(R.target)}function V(R){R.removeEventListener("dispose",P),D(R),Z(R),R.isVideoTexture&&f.delete(R),R.isHTMLTexture&&u.delete(R)}function L(R){R.removeEventListener("dispose",z),D(R),he(R)}function H(){for(let R of g){let M=R.deref();M!==void 0&&(M.isRenderTarget===!0?L(M):V(M))}g.clear(),u.clear()}function Z(R){let M=n.get(R);if(M.__webglInit===void 0)return;let X=R.source,fe=p.get(X);if(fe){let le=fe[M.__cacheKey];le.usedTimes--,le.usedTimes===0&&k(R),Object.keys(fe).length===0&&p.delete(X)}n.remove(R)}function k(R){let M=n.get(R);i.deleteTexture(M.__webglTexture);let X=R.source,fe=p.get(X);delete fe[M.__cacheKey],o.memory.textures--}function he(R){let M=n.get(R);M.__depthDisposeCallback&&M.__depthDisposeCallback();let X=R.depthTexture;if(X&&X.renderTarget===R&&V(X),R.isWebGLCubeRenderTarget)for(let le=0;le<6;le++){if(Array.isArray(M.__webglFramebuffer[le]))for(let ve=0;ve<M.__webglFramebuffer[le].length;ve++)i.deleteFramebuffer(M.__webglFramebuffer[le][ve]);else i.deleteFramebuffer(M.__webglFramebuffer[le]);M.__webglDepthbuffer&&i.deleteRenderbuffer(M.__webglDepthbuffer[le])}else{if(Array.isArray(M.__webglFramebuffer))for(let le=0;le<M.__webglFramebuffer.length;le++)i.deleteFramebuffer(M.__webglFramebuffer[le]);else i.deleteFramebuffer(M.__webglFramebuffer);if(M.__webglDepthbuffer&&i.deleteRenderbuffer(M.__webglDepthbuffer),M.__webglMultisampledFramebuffer&&i.deleteFramebuffer(M.__webglMultisampledFramebuffer),M.__webglColorRenderbuffer)for(let le=0;le<M.__webglColorRenderbuffer.length;le++)M.__webglColorRenderbuffer[le]&&i.deleteRenderbuffer(M.__webglColorRenderbuffer[le]);M.__webglDepthRenderbuffer&&i.deleteRenderbuffer(M.__webglDepthRenderbuffer)}let fe=R.textures;for(let le=0,ve=fe.length;le<ve;le++){let Se=n.get(fe[le]);Se.__webglTexture&&(i.deleteTexture(Se.__webglTexture),o.memory.textures--),n.remove(fe[le])}n.remove(R)}let Y=0;function Q(){Y=0}function ne(){return Y}function de(R){Y=R}function pe(){let R=Y;return R>=s.maxTextures&&Je("WebGLTextures: Trying to use "+(R+1)+" texture units while this GPU supports only "+s.maxTextures),Y+=1,R}function ee(R){let M=[];return M.push(R.wrapS),M.push(R.wrapT),M.push(R.wrapR||0),M.push(R.magFilter),M.push(R.minFilter),M.push(R.anisotropy),M.push(R.internalFormat),M.push(R.format),M.push(R.type),M.push(R.generateMipmaps),M.push(R.mipmapsAutoUpdate),M.push(R.premultiplyAlpha),M.push(R.flipY),M.push(R.unpackAlignment),M.push(R.colorSpace),M.join()}function _e(R,M){let X=n.get(R);if(R.isVideoTexture&&Ut(R),R.isRenderTargetTexture===!1&&R.isExternalTexture!==!0&&R.version>0&&X.__version!==R.version){let fe=R.image;if(fe===null)Je("WebGLRenderer: Texture marked for update but no image data found.");else if(fe.complete===!1)Je("WebGLRenderer: Texture marked for update but image is incomplete");else{Bt(X,R,M);return}}else R.isExternalTexture&&(X.__webglTexture=R.sourceTexture?R.sourceTexture:null);t.bindTexture(i.TEXTURE_2D,X.__webglTexture,i.TEXTURE0+M)}function ye(R,M){let X=n.get(R);if(R.isRenderTargetTexture===!1&&R.version>0&&X.__version!==R.version){Bt(X,R,M);return}else R.isExternalTexture&&(X.__webglTexture=R.sourceTexture?R.sourceTexture:null);t.bindTexture(i.TEXTURE_2D_ARRAY,X.__webglTexture,i.TEXTURE0+M)}function Re(R,M){let X=n.get(R);if(R.isRenderTargetTexture===!1&&R.version>0&&X.__version!==R.version){Bt(X,R,M);return}t.bindTexture(i.TEXTURE_3D,X.__webglTexture,i.TEXTURE0+M)}function we(R,M){let X=n.get(R);if(R.version>0&&X.__version!==R.version){rn(X,R,M);return}t.bindTexture(i.TEXTURE_CUBE_MAP,X.__webglTexture,i.TEXTURE0+M)}let qe={[Cl]:i.REPEAT,[Yi]:i.CLAMP_TO_EDGE,[Rl]:i.MIRRORED_REPEAT},rt={[fn]:i.NEAREST,[Bp]:i.NEAREST_MIPMAP_NEAREST,[da]:i.NEAREST_MIPMAP_LINEAR,[dn]:i.LINEAR,[sc]:i.LINEAR_MIPMAP_NEAREST,[vs]:i.LINEAR_MIPMAP_LINEAR},We={[Vp]:i.NEVER,[Ku]:i.ALWAYS,[Gp]:i.LESS,[Zu]:i.LEQUAL,[Hp]:i.EQUAL,[Ju]:i.GEQUAL,[Wp]:i.GREATER,[Xp]:i.NOTEQUAL};function ft(R,M){if(M.type===Ni&&e.has("OES_texture_float_linear")===!1&&(M.magFilter===dn||M.magFilter===sc||M.magFilter===da||M.magFilter===vs||M.minFilter===dn||M.minFilter===sc||M.minFilter===da||M.minFilter===vs)&&Je("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(R,i.TEXTURE_WRAP_S,qe[M.wrapS]),i.texParameteri(R,i.TEXTURE_WRAP_T,qe[M.wrapT]),(R===i.TEXTURE_3D||R===i.TEXTURE_2D_ARRAY)&&i.texParameteri(R,i.TEXTURE_WRAP_R,qe[M.wrapR]),i.texParameteri(R,i.TEXTURE_MAG_FILTER,rt[M.magFilter]),i.texParameteri(R,i.TEXTURE_MIN_FILTER,rt[M.minFilter]),M.compareFunction&&(i.texParameteri(R,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(R,i.TEXTURE_COMPARE_FUNC,We[M.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(M.magFilter===fn||M.minFilter!==da&&M.minFilter!==vs||M.type===Ni&&e.has("OES_texture_float_linear")===!1)return;if(M.anisotropy>1||n.get(M).__currentAnisotropy){let X=e.get("EXT_texture_filter_anisotropic");i.texParameterf(R,X.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(M.anisotropy,s.getMaxAnisotropy())),n.get(M).__currentAnisotropy=M.anisotropy}}}function lt(R,M){let X=!1;R.__webglInit===void 0&&(R.__webglInit=!0,M.addEventListener("dispose",P),U(M));let fe=M.source,le=p.get(fe);le===void 0&&(le={},p.set(fe,le));let ve=ee(M);if(ve!==R.__cacheKey){le[ve]===void 0&&(le[ve]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,X=!0),le[ve].usedTimes++;let Se=le[R.__cacheKey];Se!==void 0&&(le[R.__cacheKey].usedTimes--,Se.usedTimes===0&&k(M)),R.__cacheKey=ve,R.__webglTexture=le[ve].texture}return X}function it(R,M,X){return Math.floor(Math.floor(R/X)/M)}function Yt(R,M,X,fe){let ve=R.updateRanges;if(ve.length===0)t.texSubImage2D(i.TEXTURE_2D,0,0,0,M.width,M.height,X,fe,M.data);else{ve.sort((F,ae)=>F.start-ae.start);let Se=0;for(let F=1;F<ve.length;F++){let ae=ve[Se],se=ve[F],Te=ae.start+ae.count,xe=it(se.start,M.width,4),be=it(ae.start,M.width,4);se.start<=Te+1&&xe===be&&it(se.start+se.count-1,M.width,4)===xe?ae.count=Math.max(ae.count,se.start+se.count-ae.start):(++Se,ve[Se]=se)}ve.length=Se+1;let ie=t.getParameter(i.UNPACK_ROW_LENGTH),oe=t.getParameter(i.UNPACK_SKIP_PIXELS),ge=t.getParameter(i.UNPACK_SKIP_ROWS);t.pixelStorei(i.UNPACK_ROW_LENGTH,M.width);for(let F=0,ae=ve.length;F<ae;F++){let se=ve[F],Te=Math.floor(se.start/4),xe=Math.ceil(se.count/4),be=Te%M.width,Xe=Math.floor(Te/M.width),je=xe,ue=1;t.pixelStorei(i.UNPACK_SKIP_PIXELS,be),t.pixelStorei(i.UNPACK_SKIP_ROWS,Xe),t.texSubImage2D(i.TEXTURE_2D,0,be,Xe,je,ue,X,fe,M.data)}R.clearUpdateRanges(),t.pixelStorei(i.UNPACK_ROW_LENGTH,ie),t.pixelStorei(i.UNPACK_SKIP_PIXELS,oe),t.pixelStorei(i.UNPACK_SKIP_ROWS,ge)}}function Bt(R,M,X){let fe=i.TEXTURE_2D;(M.isDataArrayTexture||M.isCompressedArrayTexture)&&(fe=i.TEXTURE_2D_ARRAY),M.isData3DTexture&&(fe=i.TEXTURE_3D);let le=lt(R,M),ve=M.source;t.bindTexture(fe,R.__webglTexture,i.TEXTURE0+X);let Se=n.get(ve);if(ve.version!==Se.__version||le===!0){if(t.activeTexture(i.TEXTURE0+X),(typeof ImageBitmap<"u"&&M.image instanceof ImageBitmap)===!1){let ue=mt.getPrimaries(mt.workingColorSpace),ze=M.colorSpace===Ss?null:mt.getPrimaries(M.colorSpace),Qe=M.colorSpace===Ss||ue===ze?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,M.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,M.premultiplyAlpha),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Qe)}t.pixelStorei(i.UNPACK_ALIGNMENT,M.unpackAlignment);let oe=y(M.image,!1,s.maxTextureSize);oe=Ge(M,oe);let ge=r.convert(M.format,M.colorSpace),F=r.convert(M.type),ae=E(M.internalFormat,ge,F,M.normalized,M.colorSpace,M.isVideoTexture);ft(fe,M);let se,Te=M.mipmaps,xe=M.isVideoTexture!==!0,be=Se.__version===void 0||le===!0,Xe=ve.dataReady,je=b(M,oe);if(M.isDepthTexture)ae=_(M.format===ys,M.type),be&&(xe?t.texStorage2D(i.TEXTURE_2D,1,ae,oe.width,oe.height):t.texImage2D(i.TEXTURE_2D,0,ae,oe.width,oe.height,0,ge,F,null));else if(M.isDataTexture)if(Te.length>0){xe&&be&&t.texStorage2D(i.TEXTURE_2D,je,ae,Te[0].width,Te[0].height);for(let ue=0,ze=Te.length;ue<ze;ue++)se=Te[ue],xe?Xe&&t.texSubImage2D(i.TEXTURE_2D,ue,0,0,se.width,se.height,ge,F,se.data):t.texImage2D(i.TEXTURE_2D,ue,ae,se.width,se.height,0,ge,F,se.data);M.generateMipmaps=!1}else xe?(be&&t.texStorage2D(i.TEXTURE_2D,je,ae,oe.width,oe.height),Xe&&Yt(M,oe,ge,F)):t.texImage2D(i.TEXTURE_2D,0,ae,oe.width,oe.height,0,ge,F,oe.data);else if(M.isCompressedTexture)if(M.isCompressedArrayTexture){xe&&be&&t.texStorage3D(i.TEXTURE_2D_ARRAY,je,ae,Te[0].width,Te[0].height,oe.depth);for(let ue=0,ze=Te.length;ue<ze;ue++)if(se=Te[ue],M.format!==ci)if(ge!==null)if(xe){if(Xe)if(M.layerUpdates.size>0){let Qe=sf(se.width,se.height,M.format,M.type);for(let Pe of M.layerUpdates){let at=se.data.subarray(Pe*Qe/se.data.BYTES_PER_ELEMENT,(Pe+1)*Qe/se.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,ue,0,0,Pe,se.width,se.height,1,ge,at)}}else t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,ue,0,0,0,se.width,se.height,oe.depth,ge,se.data)}else t.compressedTexImage3D(i.TEXTURE_2D_ARRAY,ue,ae,se.width,se.height,oe.depth,0,se.data,0,0);else Je("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else xe?Xe&&t.texSubImage3D(i.TEXTURE_2D_ARRAY,ue,0,0,0,se.width,se.height,oe.depth,ge,F,se.data):t.texImage3D(i.TEXTURE_2D_ARRAY,ue,ae,se.width,se.height,oe.depth,0,ge,F,se.data);M.layerUpdates.size>0&&M.clearLayerUpdates()}else{xe&&be&&t.texStorage2D(i.TEXTURE_2D,je,ae,Te[0].width,Te[0].height);for(let ue=0,ze=Te.length;ue<ze;ue++)se=Te[ue],M.format!==ci?ge!==null?xe?Xe&&t.compressedTexSubImage2D(i.TEXTURE_2D,ue,0,0,se.width,se.height,ge,se.data):t.compressedTexImage2D(i.TEXTURE_2D,ue,ae,se.width,se.height,0,se.data):Je("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):xe?Xe&&t.texSubImage2D(i.TEXTURE_2D,ue,0,0,se.width,se.height,ge,F,se.data):t.texImage2D(i.TEXTURE_2D,ue,ae,se.width,se.height,0,ge,F,se.data)}else if(M.isDataArrayTexture)if(xe){if(be&&t.texStorage3D(i.TEXTURE_2D_ARRAY,je,ae,oe.width,oe.height,oe.depth),Xe)if(M.layerUpdates.size>0){let ue=sf(oe.width,oe.height,M.format,M.type);for(let ze of M.layerUpdates){let Qe=oe.data.subarray(ze*ue/oe.data.BYTES_PER_ELEMENT,(ze+1)*ue/oe.data.BYTES_PER_ELEMENT);t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,ze,oe.width,oe.height,1,ge,F,Qe)}M.clearLayerUpdates()}else t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,oe.width,oe.height,oe.depth,ge,F,oe.data)}else t.texImage3D(i.TEXTURE_2D_ARRAY,0,ae,oe.width,oe.height,oe.depth,0,ge,F,oe.data);else if(M.isData3DTexture)xe?(be&&t.texStorage3D(i.TEXTURE_3D,je,ae,oe.width,oe.height,oe.depth),Xe&&t.texSubImage3D(i.TEXTURE_3D,0,0,0,0,oe.width,oe.height,oe.depth,ge,F,oe.data)):t.texImage3D(i.TEXTURE_3D,0,ae,oe.width,oe.height,oe.depth,0,ge,F,oe.data);else if(M.isFramebufferTexture){if(be)if(xe)t.texStorage2D(i.TEXTURE_2D,je,ae,oe.width,oe.height);else{let ue=oe.width,ze=oe.height;for(let Qe=0;Qe<je;Qe++)t.texImage2D(i.TEXTURE_2D,Qe,ae,ue,ze,0,ge,F,null),ue>>=1,ze>>=1}}else if(M.isHTMLTexture){if("texElementImage2D"in i){let ue=i.canvas;if(ue.hasAttribute("layoutsubtree")||ue.setAttribute("layoutsubtree","true"),oe.parentNode!==ue){ue.appendChild(oe),u.add(M),ue.onpaint=ze=>{let Qe=ze.changedElements;for(let Pe of u)Qe.includes(Pe.image)&&(Pe.needsUpdate=!0)},ue.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,oe);else{let Qe=i.RGBA,Pe=i.RGBA,at=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,Qe,Pe,at,oe)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(Te.length>0){if(xe&&be){let ue=$e(Te[0]);t.texStorage2D(i.TEXTURE_2D,je,ae,ue.width,ue.height)}for(let ue=0,ze=Te.length;ue<ze;ue++)se=Te[ue],xe?Xe&&t.texSubImage2D(i.TEXTURE_2D,ue,0,0,ge,F,se):t.texImage2D(i.TEXTURE_2D,ue,ae,ge,F,se);M.generateMipmaps=!1}else if(xe){if(be){let ue=$e(oe);t.texStorage2D(i.TEXTURE_2D,je,ae,ue.width,ue.height)}Xe&&t.texSubImage2D(i.TEXTURE_2D,0,0,0,ge,F,oe)}else t.texImage2D(i.TEXTURE_2D,0,ae,ge,F,oe);T(M)&&M.mipmapsAutoUpdate===!0&&S(fe),Se.__version=ve.version,M.onUpdate&&M.onUpdate(M)}R.__version=M.version}function rn(R,M,X){if(M.image.length!==6)return;let fe=lt(R,M),le=M.source;t.bindTexture(i.TEXTURE_CUBE_MAP,R.__webglTexture,i.TEXTURE0+X);let ve=n.get(le);if(le.version!==ve.__version||fe===!0){t.activeTexture(i.TEXTURE0+X);let Se=mt.getPrimaries(mt.workingColorSpace),ie=M.colorSpace===Ss?null:mt.getPrimaries(M.colorSpace),oe=M.colorSpace===Ss||Se===ie?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,M.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,M.premultiplyAlpha),t.pixelStorei(i.UNPACK_ALIGNMENT,M.unpackAlignment),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,oe);let ge=M.isCompressedTexture||M.image[0].isCompressedTexture,F=M.image[0]&&M.image[0].isDataTexture,ae=[];for(let Pe=0;Pe<6;Pe++)!ge&&!F?ae[Pe]=y(M.image[Pe],!0,s.maxCubemapSize):ae[Pe]=F?M.image[Pe].image:M.image[Pe],ae[Pe]=Ge(M,ae[Pe]);let se=ae[0],Te=r.convert(M.format,M.colorSpace),xe=r.convert(M.type),be=E(M.internalFormat,Te,xe,M.normalized,M.colorSpace),Xe=M.isVideoTexture!==!0,je=ve.__version===void 0||fe===!0,ue=le.dataReady,ze=b(M,se);ft(i.TEXTURE_CUBE_MAP,M);let Qe;if(M.isDepthTexture){if(be=_(M.format===ys,M.type),je)if(Xe)t.texStorage2D(i.TEXTURE_CUBE_MAP,1,be,se.width,se.height);else for(let Pe=0;Pe<6;Pe++)t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,0,be,se.width,se.height,0,Te,xe,null)}else if(ge){Xe&&je&&t.texStorage2D(i.TEXTURE_CUBE_MAP,ze,be,se.width,se.height);for(let Pe=0;Pe<6;Pe++){Qe=ae[Pe].mipmaps;for(let at=0;at<Qe.length;at++){let kt=Qe[at];M.format!==ci?Te!==null?Xe?ue&&t.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,at,0,0,kt.width,kt.height,Te,kt.data):t.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,at,be,kt.width,kt.height,0,kt.data):Je("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Xe?ue&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,at,0,0,kt.width,kt.height,Te,xe,kt.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,at,be,kt.width,kt.height,0,Te,xe,kt.data)}}}else{if(Qe=M.mipmaps,Xe&&je){Qe.length>0&&ze++;let Pe=$e(ae[0]);t.texStorage2D(i.TEXTURE_CUBE_MAP,ze,be,Pe.width,Pe.height)}for(let Pe=0;Pe<6;Pe++)if(F){Xe?ue&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,0,0,0,ae[Pe].width,ae[Pe].height,Te,xe,ae[Pe].data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,0,be,ae[Pe].width,ae[Pe].height,0,Te,xe,ae[Pe].data);for(let at=0;at<Qe.length;at++){let zn=Qe[at].image[Pe].image;Xe?ue&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,at+1,0,0,zn.width,zn.height,Te,xe,zn.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,at+1,be,zn.width,zn.height,0,Te,xe,zn.data)}}else{Xe?ue&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,0,0,0,Te,xe,ae[Pe]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,0,be,Te,xe,ae[Pe]);for(let at=0;at<Qe.length;at++){let kt=Qe[at];Xe?ue&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,at+1,0,0,Te,xe,kt.image[Pe]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Pe,at+1,be,Te,xe,kt.image[Pe])}}}T(M)&&M.mipmapsAutoUpdate===!0&&S(i.TEXTURE_CUBE_MAP),ve.__version=le.version,M.onUpdate&&M.onUpdate(M)}R.__version=M.version}function Dt(R,M,X,fe,le,ve){let Se=r.convert(X.format,X.colorSpace),ie=r.convert(X.type),oe=E(X.internalFormat,Se,ie,X.normalized,X.colorSpace),ge=n.get(M),F=n.get(X);if(F.__renderTarget=M,!ge.__hasExternalTextures){let ae=Math.max(1,M.width>>ve),se=Math.max(1,M.height>>ve);le===i.TEXTURE_3D||le===i.TEXTURE_2D_ARRAY?t.texImage3D(le,ve,oe,ae,se,M.depth,0,Se,ie,null):t.texImage2D(le,ve,oe,ae,se,0,Se,ie,null)}t.bindFramebuffer(i.FRAMEBUFFER,R),Ae(M)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,fe,le,F.__webglTexture,0,ot(M)):(le===i.TEXTURE_2D||le>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&le<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,fe,le,F.__webglTexture,ve),t.bindFramebuffer(i.FRAMEBUFFER,null)}function An(R,M,X){if(i.bindRenderbuffer(i.RENDERBUFFER,R),M.depthBuffer){let fe=M.depthTexture,le=fe&&fe.isDepthTexture?fe.type:null,ve=_(M.stencilBuffer,le),Se=M.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;Ae(M)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,ot(M),ve,M.width,M.height):X?i.renderbufferStorageMultisample(i.RENDERBUFFER,ot(M),ve,M.width,M.height):i.renderbufferStorage(i.RENDERBUFFER,ve,M.width,M.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,Se,i.RENDERBUFFER,R)}else{let fe=M.textures;for(let le=0;le<fe.length;le++){let ve=fe[le],Se=r.convert(ve.format,ve.colorSpace),ie=r.convert(ve.type),oe=E(ve.internalFormat,Se,ie,ve.normalized,ve.colorSpace);Ae(M)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,ot(M),oe,M.width,M.height):X?i.renderbufferStorageMultisample(i.RENDERBUFFER,ot(M),oe,M.width,M.height):i.renderbufferStorage(i.RENDERBUFFER,oe,M.width,M.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function St(R,M,X){let fe=M.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(i.FRAMEBUFFER,R),!(M.depthTexture&&M.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let le=n.get(M.depthTexture);le.__renderTarget=M;let ve=fe?M.depthTexture.image[0]:M.depthTexture.image;(!le.__webglTexture||ve.width!==M.width||ve.height!==M.height)&&(ve.width=M.width,ve.height=M.height,M.depthTexture.needsUpdate=!0),fe?we(M.depthTexture,0):_e(M.depthTexture,0);let Se=le.__webglTexture,ie=ot(M),oe=fe?i.TEXTURE_CUBE_MAP_POSITIVE_X+X:i.TEXTURE_2D,ge=M.depthTexture.format===ys?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(M.depthTexture.format===gs)Ae(M)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ge,oe,Se,0,ie):i.framebufferTexture2D(i.FRAMEBUFFER,ge,oe,Se,0);else if(M.depthTexture.format===ys)Ae(M)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ge,oe,Se,0,ie):i.framebufferTexture2D(i.FRAMEBUFFER,ge,oe,Se,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function gn(R){let M=n.get(R),X=R.isWebGLCubeRenderTarget===!0;if(M.__boundDepthTexture!==R.depthTexture){let fe=R.depthTexture;if(M.__depthDisposeCallback&&M.__depthDisposeCallback(),fe){let le=()=>{delete M.__boundDepthTexture,delete M.__depthDisposeCallback,fe.removeEventListener("dispose",le)};fe.addEventListener("dispose",le),M.__depthDisposeCallback=le}M.__boundDepthTexture=fe}if(R.depthTexture&&!M.__autoAllocateDepthBuffer)if(X)for(let fe=0;fe<6;fe++)St(M.__webglFramebuffer[fe],R,fe);else R.texture.mipmaps.length>0?St(M.__webglFramebuffer[0],R,0):St(M.__webglFramebuffer,R,0);else if(X){M.__webglDepthbuffer=[];for(let fe=0;fe<6;fe++)if(t.bindFramebuffer(i.FRAMEBUFFER,M.__webglFramebuffer[fe]),M.__webglDepthbuffer[fe]===void 0)M.__webglDepthbuffer[fe]=i.createRenderbuffer(),An(M.__webglDepthbuffer[fe],R,!1);else{let le=R.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ve=M.__webglDepthbuffer[fe];i.bindRenderbuffer(i.RENDERBUFFER,ve),i.framebufferRenderbuffer(i.FRAMEBUFFER,le,i.RENDERBUFFER,ve)}}else if(R.texture.mipmaps.length>0?t.bindFramebuffer(i.FRAMEBUFFER,M.__webglFramebuffer[0]):t.bindFramebuffer(i.FRAMEBUFFER,M.__webglFramebuffer),M.__webglDepthbuffer===void 0)M.__webglDepthbuffer=i.createRenderbuffer(),An(M.__webglDepthbuffer,R,!1);else{let le=R.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ve=M.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,ve),i.framebufferRenderbuffer(i.FRAMEBUFFER,le,i.RENDERBUFFER,ve)}t.bindFramebuffer(i.FRAMEBUFFER,null)}function Jt(R,M,X){let fe=n.get(R);M!==void 0&&Dt(fe.__webglFramebuffer,R,R.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),X!==void 0&&gn(R)}function on(R){let M=R.texture,X=n.get(R),fe=n.get(M);R.addEventListener("dispose",z),U(R);let le=R.textures,ve=R.isWebGLCubeRenderTarget===!0,Se=le.length>1;if(Se||(fe.__webglTexture===void 0&&(fe.__webglTexture=i.createTexture()),fe.__version=M.version,o.memory.textures++),ve){X.__webglFramebuffer=[];for(let ie=0;ie<6;ie++)if(M.mipmaps.length>0){X.__webglFramebuffer[ie]=[];for(let oe=0;oe<M.mipmaps.length;oe++)X.__webglFramebuffer[ie][oe]=i.createFramebuffer()}else X.__webglFramebuffer[ie]=i.createFramebuffer()}else{if(M.mipmaps.length>0){X.__webglFramebuffer=[];for(let ie=0;ie<M.mipmaps.length;ie++)X.__webglFramebuffer[ie]=i.createFramebuffer()}else X.__webglFramebuffer=i.createFramebuffer();if(Se)for(let ie=0,oe=le.length;ie<oe;ie++){let ge=n.get(le[ie]);ge.__webglTexture===void 0&&(ge.__webglTexture=i.createTexture(),o.memory.textures++)}if(R.samples>0&&Ae(R)===!1){X.__webglMultisampledFramebuffer=i.createFramebuffer(),X.__webglColorRenderbuffer=[],t.bindFramebuffer(i.FRAMEBUFFER,X.__webglMultisampledFramebuffer);for(let ie=0;ie<le.length;ie++){let oe=le[ie];X.__webglColorRenderbuffer[ie]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,X.__webglColorRenderbuffer[ie]);let ge=r.convert(oe.format,oe.colorSpace),F=r.convert(oe.type),ae=E(oe.internalFormat,ge,F,oe.normalized,oe.colorSpace,R.isXRRenderTarget===!0),se=ot(R);i.renderbufferStorageMultisample(i.RENDERBUFFER,se,ae,R.width,R.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ie,i.RENDERBUFFER,X.__webglColorRenderbuffer[ie])}i.bindRenderbuffer(i.RENDERBUFFER,null),R.depthBuffer&&(X.__webglDepthRenderbuffer=i.createRenderbuffer(),An(X.__webglDepthRenderbuffer,R,!0)),t.bindFramebuffer(i.FRAMEBUFFER,null)}}if(ve){t.bindTexture(i.TEXTURE_CUBE_MAP,fe.__webglTexture),ft(i.TEXTURE_CUBE_MAP,M);for(let ie=0;ie<6;ie++)if(M.mipmaps.length>0)for(let oe=0;oe<M.mipmaps.length;oe++)Dt(X.__webglFramebuffer[ie][oe],R,M,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+ie,oe);else Dt(X.__webglFramebuffer[ie],R,M,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+ie,0);T(M)?S(i.TEXTURE_CUBE_MAP):M.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,M.mipmaps.length-1),t.unbindTexture()}else if(Se){for(let ie=0,oe=le.length;ie<oe;ie++){let ge=le[ie],F=n.get(ge),ae=i.TEXTURE_2D;(R.isWebGL3DRenderTarget||R.isWebGLArrayRenderTarget)&&(ae=R.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(ae,F.__webglTexture),ft(ae,ge),Dt(X.__webglFramebuffer,R,ge,i.COLOR_ATTACHMENT0+ie,ae,0),T(ge)&&S(ae)}t.unbindTexture()}else{let ie=i.TEXTURE_2D;if((R.isWebGL3DRenderTarget||R.isWebGLArrayRenderTarget)&&(ie=R.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(ie,fe.__webglTexture),ft(ie,M),M.mipmaps.length>0)for(let oe=0;oe<M.mipmaps.length;oe++)Dt(X.__webglFramebuffer[oe],R,M,i.COLOR_ATTACHMENT0,ie,oe);else Dt(X.__webglFramebuffer,R,M,i.COLOR_ATTACHMENT0,ie,0);T(M)?S(ie):M.mipmaps.length>0&&i.texParameteri(ie,i.TEXTURE_MAX_LEVEL,M.mipmaps.length-1),t.unbindTexture()}R.depthBuffer&&gn(R)}function O(R){let M=R.textures;for(let X=0,fe=M.length;X<fe;X++){let le=M[X];if(T(le)&&le.mipmapsAutoUpdate===!0){let ve=C(R),Se=n.get(le).__webglTexture;t.bindTexture(ve,Se),S(ve),t.unbindTexture()}}}let Ie=[];function Ze(R){if(R.samples>0){if(Ae(R)===!1){let M=R.textures,X=R.width,fe=R.height,le=i.COLOR_BUFFER_BIT,ve=R.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,Se=n.get(R),ie=M.length>1;if(ie)for(let ge=0;ge<M.length;ge++)t.bindFramebuffer(i.FRAMEBUFFER,Se.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ge,i.RENDERBUFFER,null),t.bindFramebuffer(i.FRAMEBUFFER,Se.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ge,i.TEXTURE_2D,null,0);t.bindFramebuffer(i.READ_FRAMEBUFFER,Se.__webglMultisampledFramebuffer),R.texture.mipmaps.length>0?t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Se.__webglFramebuffer[0]):t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Se.__webglFramebuffer);for(let ge=0;ge<M.length;ge++){if(R.resolveDepthBuffer&&(R.depthBuffer&&(le|=i.DEPTH_BUFFER_BIT),R.stencilBuffer&&R.resolveStencilBuffer&&(le|=i.STENCIL_BUFFER_BIT)),ie){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,Se.__webglColorRenderbuffer[ge]);let F=n.get(M[ge]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,F,0)}i.blitFramebuffer(0,0,X,fe,0,0,X,fe,le,i.NEAREST),l===!0&&(Ie.length=0,Ie.push(i.COLOR_ATTACHMENT0+ge),R.depthBuffer&&R.storeMultisampledDepthBuffer===!1&&Ie.push(ve),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,Ie))}if(t.bindFramebuffer(i.READ_FRAMEBUFFER,null),t.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),ie)for(let ge=0;ge<M.length;ge++){t.bindFramebuffer(i.FRAMEBUFFER,Se.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ge,i.RENDERBUFFER,Se.__webglColorRenderbuffer[ge]);let F=n.get(M[ge]).__webglTexture;t.bindFramebuffer(i.FRAMEBUFFER,Se.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+ge,i.TEXTURE_2D,F,0)}t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Se.__webglMultisampledFramebuffer)}else if(R.depthBuffer&&R.storeMultisampledDepthBuffer===!1&&l){let M=R.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[M])}}}function ot(R){return Math.min(s.maxSamples,R.samples)}function Ae(R){let M=n.get(R);return R.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&M.__useRenderToTexture!==!1}function Ut(R){let M=o.render.frame;f.get(R)!==M&&(f.set(R,M),R.update())}function Ge(R,M){let X=R.colorSpace,fe=R.format,le=R.type;return R.isCompressedTexture===!0||R.isVideoTexture===!0||X!==ir&&X!==Ss&&(mt.getTransfer(X)===Tt?(fe!==ci||le!==li)&&Je("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):et("WebGLTextures: Unsupported texture color space:",X)),M}function $e(R){return typeof HTMLImageElement<"u"&&R instanceof HTMLImageElement?(c.width=R.naturalWidth||R.width,c.height=R.naturalHeight||R.height):typeof VideoFrame<"u"&&R instanceof VideoFrame?(c.width=R.displayWidth,c.height=R.displayHeight):(c.width=R.width,c.height=R.height),c}this.allocateTextureUnit=pe,this.resetTextureUnits=Q,this.getTextureUnits=ne,this.setTextureUnits=de,this.setTexture2D=_e,this.setTexture2DArray=ye,this.setTexture3D=Re,this.setTextureCube=we,this.rebindTextures=Jt,this.setupRenderTarget=on,this.updateRenderTargetMipmap=O,this.updateMultisampleRenderTarget=Ze,this.setupDepthRenderbuffer=gn,this.setupFrameBufferTexture=Dt,this.useMultisampledRTT=Ae,this.dispose=H}function RM(i,e){function t(n,s=Ss){let r,o=mt.getTransfer(s);if(n===li)return i.UNSIGNED_BYTE;if(n===oc)return i.UNSIGNED_SHORT_4_4_4_4;if(n===ac)return i.UNSIGNED_SHORT_5_5_5_1;if(n===Vu)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===Gu)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===zu)return i.BYTE;if(n===ku)return i.SHORT;if(n===fo)return i.UNSIGNED_SHORT;if(n===rc)return i.INT;if(n===Di)return i.UNSIGNED_INT;if(n===Ni)return i.FLOAT;if(n===Ui)return i.HALF_FLOAT;if(n===Hu)return i.ALPHA;if(n===Wu)return i.RGB;if(n===ci)return i.RGBA;if(n===gs)return i.DEPTH_COMPONENT;if(n===ys)return i.DEPTH_STENCIL;if(n===pa)return i.RED;if(n===lc)return i.RED_INTEGER;if(n===Hs)return i.RG;if(n===cc)return i.RG_INTEGER;if(n===hc)return i.RGBA_INTEGER;if(n===ma||n===ga||n===_a||n===xa)if(o===Tt)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===ma)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===ga)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===_a)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===xa)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===ma)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===ga)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===_a)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===xa)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===uc||n===fc||n===dc||n===pc)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===uc)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===fc)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===dc)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===pc)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===mc||n===gc||n===_c||n===xc||n===vc||n===va||n===yc)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(n===mc||n===gc)return o===Tt?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===_c)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===xc)return r.COMPRESSED_R11_EAC;if(n===vc)return r.COMPRESSED_SIGNED_R11_EAC;if(n===va)return r.COMPRESSED_RG11_EAC;if(n===yc)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===Sc||n===Mc||n===bc||n===wc||n===Ac||n===Tc||n===Ec||n===Cc||n===Rc||n===Pc||n===Ic||n===Lc||n===Dc||n===Nc)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(n===Sc)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Mc)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===bc)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===wc)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Ac)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===Tc)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===Ec)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===Cc)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===Rc)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Pc)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Ic)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===Lc)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Dc)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===Nc)return o===Tt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Uc||n===Fc||n===Oc)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(n===Uc)return o===Tt?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===Fc)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===Oc)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===Bc||n===zc||n===ya||n===kc)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(n===Bc)return r.COMPRESSED_RED_RGTC1_EXT;if(n===zc)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===ya)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===kc)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===fr?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:t}}var PM=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,IM=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,df=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let n=new oa(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=n}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,n=new Ji({vertexShader:PM,fragmentShader:IM,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new vn(new aa(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},pf=class extends $i{constructor(e,t){super();let n=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,f=null,u=null,h=null,p=null,g=null,v=typeof XRWebGLBinding<"u",d=new df,m={},y=t.getContextAttributes(),T=null,S=null,C=[],E=[],_=new xt,b=null,U=null,D=new Ln;D.viewport=new Lt;let P=new Ln;P.viewport=new Lt;let z=[D,P],V=new tc,L=null,H=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(ee){let _e=C[ee];return _e===void 0&&(_e=new ro,C[ee]=_e),_e.getTargetRaySpace()},this.getControllerGrip=function(ee){let _e=C[ee];return _e===void 0&&(_e=new ro,C[ee]=_e),_e.getGripSpace()},this.getHand=function(ee){let _e=C[ee];return _e===void 0&&(_e=new ro,C[ee]=_e),_e.getHandSpace()};function Z(ee){let _e=E.indexOf(ee.inputSource);if(_e===-1)return;let ye=C[_e];ye!==void 0&&(ye.update(ee.inputSource,ee.frame,c||o),ye.dispatchEvent({type:ee.type,data:ee.inputSource}))}function k(){s.removeEventListener("select",Z),s.removeEventListener("selectstart",Z),s.removeEventListener("selectend",Z),s.removeEventListener("squeeze",Z),s.removeEventListener("squeezestart",Z),s.removeEventListener("squeezeend",Z),s.removeEventListener("end",k),s.removeEventListener("inputsourceschange",he);for(let ee=0;ee<C.length;ee++){let _e=E[ee];_e!==null&&(E[ee]=null,C[ee].disconnect(_e))}L=null,H=null,d.reset();for(let ee in m)delete m[ee];if(e.setRenderTarget(T),p=null,h=null,u=null,s=null,S=null,pe.stop(),n.isPresenting=!1,e.setPixelRatio(b),e.setSize(_.width,_.height,!1),U!==null){let ee=U.camera;ee.fov=U.fov,ee.zoom=U.zoom,ee.updateProjectionMatrix(),U=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(ee){r=ee,n.isPresenting===!0&&Je("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(ee){a=ee,n.isPresenting===!0&&Je("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(ee){c=ee},this.getBaseLayer=function(){return h!==null?h:p},this.getBinding=function(){return u===null&&v&&(u=new XRWebGLBinding(s,t)),u},this.getFrame=function(){return g},this.getSession=function(){return s},this.setSession=async function(ee){if(s=ee,s!==null){if(T=e.getRenderTarget(),s.addEventListener("select",Z),s.addEventListener("selectstart",Z),s.addEventListener("selectend",Z),s.addEventListener("squeeze",Z),s.addEventListener("squeezestart",Z),s.addEventListener("squeezeend",Z),s.addEventListener("end",k),s.addEventListener("inputsourceschange",he),y.xrCompatible!==!0&&await t.makeXRCompatible(),b=e.getPixelRatio(),e.getSize(_),v&&"createProjectionLayer"in XRWebGLBinding.prototype){let ye=null,Re=null,we=null;y.depth&&(we=y.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,ye=y.stencil?ys:gs,Re=y.stencil?fr:Di);let qe={colorFormat:t.RGBA8,depthFormat:we,scaleFactor:r};u=this.getBinding(),h=u.createProjectionLayer(qe),s.updateRenderState({layers:[h]}),e.setPixelRatio(1),e.setSize(h.textureWidth,h.textureHeight,!1),S=new ri(h.textureWidth,h.textureHeight,{format:ci,type:li,depthTexture:new xs(h.textureWidth,h.textureHeight,Re,void 0,void 0,void 0,void 0,void 0,void 0,ye),stencilBuffer:y.stencil,colorSpace:e.outputColorSpace,samples:y.antialias?4:0,resolveDepthBuffer:h.ignoreDepthValues===!1,resolveStencilBuffer:h.ignoreDepthValues===!1,storeMultisampledDepthBuffer:h.ignoreDepthValues===!1,storeMultisampledStencilBuffer:h.ignoreDepthValues===!1})}else{let ye={antialias:y.antialias,alpha:!0,depth:y.depth,stencil:y.stencil,framebufferScaleFactor:r};p=new XRWebGLLayer(s,t,ye),s.updateRenderState({baseLayer:p}),e.setPixelRatio(1),e.setSize(p.framebufferWidth,p.framebufferHeight,!1),S=new ri(p.framebufferWidth,p.framebufferHeight,{format:ci,type:li,colorSpace:e.outputColorSpace,stencilBuffer:y.stencil,resolveDepthBuffer:p.ignoreDepthValues===!1,resolveStencilBuffer:p.ignoreDepthValues===!1,storeMultisampledDepthBuffer:p.ignoreDepthValues===!1,storeMultisampledStencilBuffer:p.ignoreDepthValues===!1})}S.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),pe.setContext(s),pe.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return d.getDepthTexture()};function he(ee){for(let _e=0;_e<ee.removed.length;_e++){let ye=ee.removed[_e],Re=E.indexOf(ye);Re>=0&&(E[Re]=null,C[Re].disconnect(ye))}for(let _e=0;_e<ee.added.length;_e++){let ye=ee.added[_e],Re=E.indexOf(ye);if(Re===-1){for(let qe=0;qe<C.length;qe++)if(qe>=E.length){E.push(ye),Re=qe;break}else if(E[qe]===null){E[qe]=ye,Re=qe;break}if(Re===-1)break}let we=C[Re];we&&we.connect(ye)}}function Y(ee,_e){_e===null?ee.matrixWorld.copy(ee.matrix):ee.matrixWorld.multiplyMatrices(_e.matrixWorld,ee.matrix),ee.matrixWorldInverse.copy(ee.matrixWorld).invert()}this.updateCamera=function(ee){if(s===null)return;let _e=ee.near,ye=ee.far;d.texture!==null&&(d.depthNear>0&&(_e=d.depthNear),d.depthFar>0&&(ye=d.depthFar)),V.near=P.near=D.near=_e,V.far=P.far=D.far=ye,(L!==V.near||H!==V.far)&&(s.updateRenderState({depthNear:V.near,depthFar:V.far}),L=V.near,H=V.far),V.layers.mask=ee.layers.mask|6,D.layers.mask=V.layers.mask&-5,P.layers.mask=V.layers.mask&-3;let Re=ee.parent,we=V.cameras;Y(V,Re);for(let qe=0;qe<we.length;qe++)Y(we[qe],Re);V.projectionMatrix.copy(D.projectionMatrix),V.projectionMatrixInverse.copy(D.projectionMatrixInverse),U===null&&ee.isPerspectiveCamera&&(U={camera:ee,fov:ee.fov,zoom:ee.zoom}),Q(ee,V,Re)};function Q(ee,_e,ye){ye===null?ee.matrix.copy(_e.matrixWorld):(ee.matrix.copy(ye.matrixWorld),ee.matrix.invert(),ee.matrix.multiply(_e.matrixWorld)),ee.matrix.decompose(ee.position,ee.quaternion,ee.scale),ee.updateMatrixWorld(!0),ee.projectionMatrix.copy(_e.projectionMatrix),ee.projectionMatrixInverse.copy(_e.projectionMatrixInverse),ee.isPerspectiveCamera&&(ee.fov=Il*2*Math.atan(1/ee.projectionMatrix.elements[5]),ee.zoom=1)}this.getCamera=function(){return V},this.getFoveation=function(){if(!(h===null&&p===null))return l},this.setFoveation=function(ee){l=ee,h!==null&&(h.fixedFoveation=ee),p!==null&&p.fixedFoveation!==void 0&&(p.fixedFoveation=ee)},this.hasDepthSensing=function(){return d.texture!==null},this.getDepthSensingMesh=function(){return d.getMesh(V)},this.getCameraTexture=function(ee){return m[ee]};let ne=null;function de(ee,_e){if(f=_e.getViewerPose(c||o),g=_e,f!==null){let ye=f.views;p!==null&&(e.setRenderTargetFramebuffer(S,p.framebuffer),e.setRenderTarget(S));let Re=!1;ye.length!==V.cameras.length&&(V.cameras.length=0,Re=!0);for(let We=0;We<ye.length;We++){let ft=ye[We],lt=null;if(p!==null)lt=p.getViewport(ft);else{let Yt=u.getViewSubImage(h,ft);lt=Yt.viewport,We===0&&(e.setRenderTargetTextures(S,Yt.colorTexture,Yt.depthStencilTexture),e.setRenderTarget(S))}let it=z[We];it===void 0&&(it=new Ln,it.layers.enable(We),it.viewport=new Lt,z[We]=it),it.matrix.fromArray(ft.transform.matrix),it.matrix.decompose(it.position,it.quaternion,it.scale),it.projectionMatrix.fromArray(ft.projectionMatrix),it.projectionMatrixInverse.copy(it.projectionMatrix).invert(),it.viewport.set(lt.x,lt.y,lt.width,lt.height),We===0&&(V.matrix.copy(it.matrix),V.matrix.decompose(V.position,V.quaternion,V.scale)),Re===!0&&V.cameras.push(it)}let we=s.enabledFeatures;if(we&&we.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&v){u=n.getBinding();let We=u.getDepthInformation(ye[0]);We&&We.isValid&&We.texture&&d.init(We,s.renderState)}if(we&&we.includes("camera-access")&&v){e.state.unbindTexture(),u=n.getBinding();for(let We=0;We<ye.length;We++){let ft=ye[We].camera;if(ft){let lt=m[ft];lt||(lt=new oa,m[ft]=lt);let it=u.getCameraImage(ft);lt.sourceTexture=it}}}}for(let ye=0;ye<C.length;ye++){let Re=E[ye],we=C[ye];Re!==null&&we!==void 0&&we.update(Re,_e,c||o)}ne&&ne(ee,_e),_e.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:_e}),g=null}let pe=new wm;pe.setAnimationLoop(de),this.setAnimationLoop=function(ee){ne=ee},this.dispose=function(){}}},LM=new It,Nm=new nt;Nm.set(-1,0,0,0,1,0,0,0,1);function DM(i,e){function t(d,m){d.matrixAutoUpdate===!0&&d.updateMatrix(),m.value.copy(d.matrix)}function n(d,m){m.color.getRGB(d.fogColor.value,ef(i)),m.isFog?(d.fogNear.value=m.near,d.fogFar.value=m.far):m.isFogExp2&&(d.fogDensity.value=m.density)}function s(d,m,y,T,S){m.isNodeMaterial?m.uniformsNeedUpdate=!1:m.isMeshBasicMaterial?r(d,m):m.isMeshLambertMaterial?(r(d,m),m.envMap&&(d.envMapIntensity.value=m.envMapIntensity)):m.isMeshToonMaterial?(r(d,m),u(d,m)):m.isMeshPhongMaterial?(r(d,m),f(d,m),m.envMap&&(d.envMapIntensity.value=m.envMapIntensity)):m.isMeshStandardMaterial?(r(d,m),h(d,m),m.isMeshPhysicalMaterial&&p(d,m,S)):m.isMeshMatcapMaterial?(r(d,m),g(d,m)):m.isMeshDepthMaterial?r(d,m):m.isMeshDistanceMaterial?(r(d,m),v(d,m)):m.isMeshNormalMaterial?r(d,m):m.isLineBasicMaterial?(o(d,m),m.isLineDashedMaterial&&a(d,m)):m.isPointsMaterial?l(d,m,y,T):m.isSpriteMaterial?c(d,m):m.isShadowMaterial?(d.color.value.copy(m.color),d.opacity.value=m.opacity):m.isShaderMaterial&&(m.uniformsNeedUpdate=!1)}function r(d,m){d.opacity.value=m.opacity,m.color&&d.diffuse.value.copy(m.color),m.emissive&&d.emissive.value.copy(m.emissive).multiplyScalar(m.emissiveIntensity),m.map&&(d.map.value=m.map,t(m.map,d.mapTransform)),m.alphaMap&&(d.alphaMap.value=m.alphaMap,t(m.alphaMap,d.alphaMapTransform)),m.bumpMap&&(d.bumpMap.value=m.bumpMap,t(m.bumpMap,d.bumpMapTransform),d.bumpScale.value=m.bumpScale,m.side===pn&&(d.bumpScale.value*=-1)),m.normalMap&&(d.normalMap.value=m.normalMap,t(m.normalMap,d.normalMapTransform),d.normalScale.value.copy(m.normalScale),m.side===pn&&d.normalScale.value.negate()),m.displacementMap&&(d.displacementMap.value=m.displacementMap,t(m.displacementMap,d.displacementMapTransform),d.displacementScale.value=m.displacementScale,d.displacementBias.value=m.displacementBias),m.emissiveMap&&(d.emissiveMap.value=m.emissiveMap,t(m.emissiveMap,d.emissiveMapTransform)),m.specularMap&&(d.specularMap.value=m.specularMap,t(m.specularMap,d.specularMapTransform)),m.alphaTest>0&&(d.alphaTest.value=m.alphaTest);let y=e.get(m),T=y.envMap,S=y.envMapRotation;T&&(d.envMap.value=T,d.envMapRotation.value.setFromMatrix4(LM.makeRotationFromEuler(S)).transpose(),T.isCubeTexture&&T.isRenderTargetTexture===!1&&d.envMapRotation.value.premultiply(Nm),d.reflectivity.value=m.reflectivity,d.ior.value=m.ior,d.refractionRatio.value=m.refractionRatio),m.lightMap&&(d.lightMap.value=m.lightMap,d.lightMapIntensity.value=m.lightMapIntensity,t(m.lightMap,d.lightMapTransform)),m.aoMap&&(d.aoMap.value=m.aoMap,d.aoMapIntensity.value=m.aoMapIntensity,t(m.aoMap,d.aoMapTransform))}function o(d,m){d.diffuse.value.copy(m.color),d.opacity.value=m.opacity,m.map&&(d.map.value=m.map,t(m.map,d.mapTransform))}function a(d,m){d.dashSize.value=m.dashSize,d.totalSize.value=m.dashSize+m.gapSize,d.scale.value=m.scale}function l(d,m,y,T){d.diffuse.value.copy(m.color),d.opacity.value=m.opacity,d.size.value=m.size*y,d.scale.value=T*.5,m.map&&(d.map.value=m.map,t(m.map,d.uvTransform)),m.alphaMap&&(d.alphaMap.value=m.alphaMap,t(m.alphaMap,d.alphaMapTransform)),m.alphaTest>0&&(d.alphaTest.value=m.alphaTest)}function c(d,m){d.diffuse.value.copy(m.color),d.opacity.value=m.opacity,d.rotation.value=m.rotation,m.map&&(d.map.value=m.map,t(m.map,d.mapTransform)),m.alphaMap&&(d.alphaMap.value=m.alphaMap,t(m.alphaMap,d.alphaMapTransform)),m.alphaTest>0&&(d.alphaTest.value=m.alphaTest)}function f(d,m){d.specular.value.copy(m.specular),d.shininess.value=Math.max(m.shininess,1e-4)}function u(d,m){m.gradientMap&&(d.gradientMap.value=m.gradientMap)}function h(d,m){d.metalness.value=m.metalness,m.metalnessMap&&(d.metalnessMap.value=m.metalnessMap,t(m.metalnessMap,d.metalnessMapTransform)),d.roughness.value=m.roughness,m.roughnessMap&&(d.roughnessMap.value=m.roughnessMap,t(m.roughnessMap,d.roughnessMapTransform)),m.envMap&&(d.envMapIntensity.value=m.envMapIntensity)}function p(d,m,y){d.ior.value=m.ior,m.diffuseRoughness>0&&(d.diffuseRoughness.value=m.diffuseRoughness,m.diffuseRoughnessMap&&(d.diffuseRoughnessMap.value=m.diffuseRoughnessMap,t(m.diffuseRoughnessMap,d.diffuseRoughnessMapTransform))),m.sheen>0&&(d.sheenColor.value.copy(m.sheenColor).multiplyScalar(m.sheen),d.sheenRoughness.value=m.sheenRoughness,m.sheenColorMap&&(d.sheenColorMap.value=m.sheenColorMap,t(m.sheenColorMap,d.sheenColorMapTransform)),m.sheenRoughnessMap&&(d.sheenRoughnessMap.value=m.sheenRoughnessMap,t(m.sheenRoughnessMap,d.sheenRoughnessMapTransform))),m.clearcoat>0&&(d.clearcoat.value=m.clearcoat,d.clearcoatRoughness.value=m.clearcoatRoughness,m.clearcoatMap&&(d.clearcoatMap.value=m.clearcoatMap,t(m.clearcoatMap,d.clearcoatMapTransform)),m.clearcoatRoughnessMap&&(d.clearcoatRoughnessMap.value=m.clearcoatRoughnessMap,t(m.clearcoatRoughnessMap,d.clearcoatRoughnessMapTransform)),m.clearcoatNormalMap&&(d.clearcoatNormalMap.value=m.clearcoatNormalMap,t(m.clearcoatNormalMap,d.clearcoatNormalMapTransform),d.clearcoatNormalScale.value.copy(m.clearcoatNormalScale),m.side===pn&&d.clearcoatNormalScale.value.negate())),m.dispersion>0&&(d.dispersion.value=m.dispersion),m.retroreflectivity>0&&(d.retroreflectivity.value=m.retroreflectivity),m.iridescence>0&&(d.iridescence.value=m.iridescence,d.iridescenceIOR.value=m.iridescenceIOR,d.iridescenceThicknessMinimum.value=m.iridescenceThicknessMinimum,d.iridescenceThicknessMaximum.value=m.iridescenceThicknessMaximum,m.iridescenceMap&&(d.iridescenceMap.value=m.iridescenceMap,t(m.iridescenceMap,d.iridescenceMapTransform)),m.iridescenceThicknessMap&&(d.iridescenceThicknessMap.value=m.iridescenceThicknessMap,t(m.iridescenceThicknessMap,d.iridescenceThicknessMapTransform))),m.transmission>0&&(d.transmission.value=m.transmission,d.transmissionSamplerMap.value=y.texture,d.transmissionSamplerSize.value.set(y.width,y.height),m.transmissionMap&&(d.transmissionMap.value=m.transmissionMap,t(m.transmissionMap,d.transmissionMapTransform)),d.thickness.value=m.thickness,m.thicknessMap&&(d.thicknessMap.value=m.thicknessMap,t(m.thicknessMap,d.thicknessMapTransform)),d.attenuationDistance.value=m.attenuationDistance,d.attenuationColor.value.copy(m.attenuationColor)),m.anisotropy>0&&(d.anisotropyVector.value.set(m.anisotropy*Math.cos(m.anisotropyRotation),m.anisotropy*Math.sin(m.anisotropyRotation)),m.anisotropyMap&&(d.anisotropyMap.value=m.anisotropyMap,t(m.anisotropyMap,d.anisotropyMapTransform))),d.specularIntensity.value=m.specularIntensity,d.specularColor.value.copy(m.specularColor),m.specularColorMap&&(d.specularColorMap.value=m.specularColorMap,t(m.specularColorMap,d.specularColorMapTransform)),m.specularIntensityMap&&(d.specularIntensityMap.value=m.specularIntensityMap,t(m.specularIntensityMap,d.specularIntensityMapTransform))}function g(d,m){m.matcap&&(d.matcap.value=m.matcap)}function v(d,m){let y=e.get(m).light;d.referencePosition.value.setFromMatrixPosition(y.matrixWorld),d.nearDistance.value=y.shadow.camera.near,d.farDistance.value=y.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function NM(i,e,t,n){let s={},r={};function o(y,T){let S=T.program;n.uniformBlockBinding(y,S,s[y.id])}function a(y,T){let S=s[y.id];S===void 0&&(g(y),S=l(y),s[y.id]=S,y.addEventListener("dispose",d));let C=T.program;n.updateUBOMapping(y,C);let E=e.render.frame;r[y.id]!==E&&(c(y),r[y.id]=E)}function l(y){let T=i.createBuffer(),S=y.__size,C=y.usage;return i.bindBuffer(i.UNIFORM_BUFFER,T),i.bufferData(i.UNIFORM_BUFFER,S,C),i.bindBuffer(i.UNIFORM_BUFFER,null),T}function c(y){let T=s[y.id],S=y.uniforms,C=y.__cache;i.bindBuffer(i.UNIFORM_BUFFER,T);for(let E=0,_=S.length;E<_;E++){let b=S[E];if(Array.isArray(b))for(let U=0,D=b.length;U<D;U++)f(b[U],E,U,C);else f(b,E,0,C)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function f(y,T,S,C){if(h(y,T,S,C)===!0){let E=y.__offset,_=y.value;if(Array.isArray(_)){let b=0;for(let U=0;U<_.length;U++){let D=_[U],P=v(D,!0);u(D,y.__data,b),b+=P.storage/Float32Array.BYTES_PER_ELEMENT}}else u(_,y.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,E,y.__data)}}function u(y,T,S){typeof y=="number"||typeof y=="boolean"?T[S]=y:y.isMatrix3?(T[S]=y.elements[0],T[S+1]=y.elements[1],T[S+2]=y.elements[2],T[S+3]=0,T[S+4]=y.elements[3],T[S+5]=y.elements[4],T[S+6]=y.elements[5],T[S+7]=0,T[S+8]=y.elements[6],T[S+9]=y.elements[7],T[S+10]=y.elements[8],T[S+11]=0):ArrayBuffer.isView(y)?T.set(y.subarray(0,T.length-S),S):y.toArray(T,S)}function h(y,T,S,C){let E=y.value,_=T+"_"+S;if(Array.isArray(E)){C[_]===void 0&&(C[_]=[]);let b=C[_],U=!1;for(let D=0;D<E.length;D++)p(E[D],b,D)===!0&&(U=!0);return U}return p(E,C,_)}function p(y,T,S){if(T[S]===void 0)return typeof y=="number"||typeof y=="boolean"?T[S]=y:ArrayBuffer.isView(y)?T[S]=y.slice():T[S]=y.clone(),!0;{let C=T[S];if(typeof y=="number"||typeof y=="boolean"){if(C!==y)return T[S]=y,!0}else{if(ArrayBuffer.isView(y))return!0;if(C.equals(y)===!1)return C.copy(y),!0}}return!1}function g(y){let T=y.uniforms,S=0,C=16;for(let _=0,b=T.length;_<b;_++){let U=Array.isArray(T[_])?T[_]:[T[_]];for(let D=0,P=U.length;D<P;D++){let z=U[D],V=Array.isArray(z.value)?z.value:[z.value],L=Array.isArray(T[_])||Array.isArray(z.value),H=S;for(let k=0,he=V.length;k<he;k++){let Y=V[k],Q=v(Y,L),ne=S%C,de=ne%Q.boundary,pe=ne+de;S+=de,pe!==0&&C-pe<Q.storage&&(S+=C-pe),k===0&&(H=S),S+=Q.storage}let Z=z.type==="int"?Int32Array:z.type==="uint"?Uint32Array:Float32Array;z.__data=new Z((S-H)/Float32Array.BYTES_PER_ELEMENT),z.__offset=H}}let E=S%C;return E>0&&(S+=C-E),y.__size=S,y.__cache={},this}function v(y,T){let S={boundary:0,storage:0};return typeof y=="number"||typeof y=="boolean"?(S.boundary=4,S.storage=4):y.isVector2?(S.boundary=8,S.storage=8):y.isVector3||y.isColor?(S.boundary=16,S.storage=12):y.isVector4?(S.boundary=16,S.storage=16):y.isMatrix3?(S.boundary=16,S.storage=48):y.isMatrix4?(S.boundary=16,S.storage=64):y.isTexture?Je("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(y)?(S.boundary=16,S.storage=y.byteLength):Je("WebGLRenderer: Unsupported uniform value type.",y),T===!0&&(S.boundary=16,S.storage=Math.ceil(S.storage/16)*16),S}function d(y){let T=y.target;T.removeEventListener("dispose",d),i.deleteBuffer(s[T.id]),delete s[T.id],delete r[T.id]}function m(){for(let y in s)i.deleteBuffer(s[y]);s={},r={}}return{bind:o,update:a,dispose:m}}var UM=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),ji=null;function FM(){return ji===null&&(ji=new oo(UM,16,16,Hs,Ui),ji.name="DFG_LUT",ji.minFilter=dn,ji.magFilter=dn,ji.wrapS=Yi,ji.wrapT=Yi,ji.generateMipmaps=!1,ji.needsUpdate=!0),ji}var qc=class{constructor(e={}){let{canvas:t=qp(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:f="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:h=!1,outputBufferType:p=li}=e;this.isWebGLRenderer=!0;let g;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");g=n.getContextAttributes().alpha}else g=o;let v=p,d=new Set([hc,cc,lc]),m=new Set([li,Di,fo,fr,oc,ac]),y=new Uint32Array(4),T=new Int32Array(4),S={textures:[],min:[],max:[],resolution:[]},C=null,E=null,_=[],b=[],U=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Ki,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let D=this,P=!1,z=null,V=null,L=null,H=null;this._outputColorSpace=si;let Z=0,k=0,he=null,Y=-1,Q=null,ne=new Lt,de=new Lt,pe=null,ee=new ht(0),_e=0,ye=t.width,Re=t.height,we=1,qe=null,rt=null,We=new Lt(0,0,ye,Re),ft=new Lt(0,0,ye,Re),lt=!1,it=new ar,Yt=new Fl,Bt=!1,rn=!1,Dt=new It,An=new W,St=new Lt,gn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},Jt=!1;function on(){return he===null?we:1}let O=n;function Ie(A,B){return t.getContext(A,B)}let Ze,ot,Ae,Ut,Ge,$e,R,M,X,fe,le,ve,Se,ie,oe,ge,F,ae,se,Te,xe,be,Xe;try{let A={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:f,failIfMajorPerformanceCaveat:u};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",ze,!1),t.addEventListener("webglcontextrestored",Qe,!1),t.addEventListener("webglcontextcreationerror",Pe,!1),O===null){let B="webgl2";if(O=Ie(B,A),O===null)throw Ie(B)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}je()}catch(A){throw t.removeEventListener("webglcontextlost",ze,!1),t.removeEventListener("webglcontextrestored",Qe,!1),t.removeEventListener("webglcontextcreationerror",Pe,!1),et("WebGLRenderer: "+A.message),A}function je(){Ze=new Yy(O),Ze.init(),xe=new RM(O,Ze),ot=new Fy(O,Ze,e,xe),Ae=new EM(O,Ze),ot.reversedDepthBuffer&&h&&Ae.buffers.depth.setReversed(!0),V=O.createFramebuffer(),L=O.createFramebuffer(),H=O.createFramebuffer(),Ut=new Jy(O),Ge=new dM,$e=new CM(O,Ze,Ae,Ge,ot,xe,Ut),R=new qy(D),M=new j_(O),be=new Ny(O,M),X=new $y(O,M,Ut,be),fe=new jy(O,X,M,be,Ut),ae=new Ky(O,ot,$e),oe=new Oy(Ge),le=new fM(D,R,Ze,ot,be,oe),ve=new DM(D,Ge),Se=new mM,ie=new SM(Ze),F=new Dy(D,R,Ae,fe,g,l),ge=new TM(D,fe,ot),Xe=new NM(O,Ut,ot,Ae),se=new Uy(O,Ze,Ut),Te=new Zy(O,Ze,Ut),Ut.programs=le.programs,D.capabilities=ot,D.extensions=Ze,D.properties=Ge,D.renderLists=Se,D.shadowMap=ge,D.state=Ae,D.info=Ut}v!==li&&(U=new eS(v,t.width,t.height,a,s,r));let ue=new pf(D,O);this.xr=ue,this.getContext=function(){return O},this.getContextAttributes=function(){return O.getContextAttributes()},this.forceContextLoss=function(){let A=Ze.get("WEBGL_lose_context");A&&A.loseContext()},this.forceContextRestore=function(){let A=Ze.get("WEBGL_lose_context");A&&A.restoreContext()},this.getPixelRatio=function(){return we},this.setPixelRatio=function(A){A!==void 0&&(we=A,this.setSize(ye,Re,!1))},this.getSize=function(A){return A.set(ye,Re)},this.setSize=function(A,B,K=!0){if(ue.isPresenting){Je("WebGLRenderer: Can't change size while VR device is presenting.");return}ye=A,Re=B,t.width=Math.floor(A*we),t.height=Math.floor(B*we),K===!0&&(t.style.width=A+"px",t.style.height=B+"px"),U!==null&&U.setSize(t.width,t.height),this.setViewport(0,0,A,B)},this.getDrawingBufferSize=function(A){return A.set(ye*we,Re*we).floor()},this.setDrawingBufferSize=function(A,B,K){ye=A,Re=B,we=K,t.width=Math.floor(A*K),t.height=Math.floor(B*K),this.setViewport(0,0,A,B)},this.setEffects=function(A){if(v===li){et("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(A){for(let B=0;B<A.length;B++)if(A[B].isOutputPass===!0){Je("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}U.setEffects(A||[])},this.getCurrentViewport=function(A){return A.copy(ne)},this.getViewport=function(A){return A.copy(We)},this.setViewport=function(A,B,K,q){A.isVector4?We.set(A.x,A.y,A.z,A.w):We.set(A,B,K,q),Ae.viewport(ne.copy(We).multiplyScalar(on()).round())},this.getScissor=function(A){return A.copy(ft)},this.setScissor=function(A,B,K,q){A.isVector4?ft.set(A.x,A.y,A.z,A.w):ft.set(A,B,K,q),Ae.scissor(de.copy(ft).multiplyScalar(on()).round())},this.getScissorTest=function(){return lt},this.setScissorTest=function(A){Ae.setScissorTest(lt=A)},this.setOpaqueSort=function(A){qe=A},this.setTransparentSort=function(A){rt=A},this.getClearColor=function(A){return A.copy(F.getClearColor())},this.setClearColor=function(){F.setClearColor(...arguments)},this.getClearAlpha=function(){return F.getClearAlpha()},this.setClearAlpha=function(){F.setClearAlpha(...arguments)},this.clear=function(A=!0,B=!0,K=!0){let q=0;if(A){let $=!1;if(he!==null){let Ee=he.texture.format;$=d.has(Ee)}if($){let Ee=he.texture.type,Le=m.has(Ee),Ce=F.getClearColor(),De=F.getClearAlpha(),Ve=Ce.r,tt=Ce.g,dt=Ce.b;Le?(y[0]=Ve,y[1]=tt,y[2]=dt,y[3]=De,O.clearBufferuiv(O.COLOR,0,y)):(T[0]=Ve,T[1]=tt,T[2]=dt,T[3]=De,O.clearBufferiv(O.COLOR,0,T))}else q|=O.COLOR_BUFFER_BIT}B&&(q|=O.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),K&&(q|=O.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),q!==0&&O.clear(q)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(A){A.setRenderer(this),z=A},this.dispose=function(){t.removeEventListener("webglcontextlost",ze,!1),t.removeEventListener("webglcontextrestored",Qe,!1),t.removeEventListener("webglcontextcreationerror",Pe,!1),F.dispose(),Se.dispose(),ie.dispose(),$e.dispose(),Ge.dispose(),R.dispose(),fe.dispose(),X.dispose(),be.dispose(),Xe.dispose(),le.dispose(),ue.dispose(),ue.removeEventListener("sessionstart",Xa),ue.removeEventListener("sessionend",zi),rs.stop()};function ze(A){A.preventDefault(),jo("WebGLRenderer: Context Lost."),P=!0}function Qe(){jo("WebGLRenderer: Context Restored."),P=!1;let A=Ut.autoReset,B=ge.enabled,K=ge.autoUpdate,q=ge.needsUpdate,$=ge.type;je(),Ut.autoReset=A,ge.enabled=B,ge.autoUpdate=K,ge.needsUpdate=q,ge.type=$}function Pe(A){et("WebGLRenderer: A WebGL context could not be created. Reason: ",A.statusMessage)}function at(A){let B=A.target;B.removeEventListener("dispose",at),kt(B)}function kt(A){zn(A),Ge.remove(A)}function zn(A){let B=Ge.get(A).programs;B!==void 0&&(B.forEach(function(K){le.releaseProgram(K)}),A.isShaderMaterial&&le.releaseShaderCache(A))}this.renderBufferDirect=function(A,B,K,q,$,Ee){B===null&&(B=gn);let Le=$.isMesh&&$.matrixWorld.determinantAffine()<0,Ce=Oo(A,B,K,q,$);Ae.setMaterial(q,Le);let De=K.index,Ve=1;if(q.wireframe===!0){if(De=X.getWireframeAttribute(K),De===void 0)return;Ve=2}let tt=K.drawRange,dt=K.attributes.position,ke=tt.start*Ve,pt=(tt.start+tt.count)*Ve;Ee!==null&&(ke=Math.max(ke,Ee.start*Ve),pt=Math.min(pt,(Ee.start+Ee.count)*Ve)),De!==null?(ke=Math.max(ke,0),pt=Math.min(pt,De.count)):dt!=null&&(ke=Math.max(ke,0),pt=Math.min(pt,dt.count));let Zt=pt-ke;if(Zt<0||Zt===1/0)return;be.setup($,q,Ce,K,De);let Ct,Rt=se;if(De!==null&&(Ct=M.get(De),Rt=Te,Rt.setIndex(Ct)),$.isMesh)q.wireframe===!0?(Ae.setLineWidth(q.wireframeLinewidth*on()),Rt.setMode(O.LINES)):Rt.setMode(O.TRIANGLES);else if($.isLine){let _n=q.linewidth;_n===void 0&&(_n=1),Ae.setLineWidth(_n*on()),$.isLineSegments?Rt.setMode(O.LINES):$.isLineLoop?Rt.setMode(O.LINE_LOOP):Rt.setMode(O.LINE_STRIP)}else $.isPoints?Rt.setMode(O.POINTS):$.isSprite&&Rt.setMode(O.TRIANGLES);if($.isBatchedMesh)if(Ze.get("WEBGL_multi_draw"))Rt.renderMultiDraw($._multiDrawStarts,$._multiDrawCounts,$._multiDrawCount);else{let _n=$._multiDrawStarts,Oe=$._multiDrawCounts,an=$._multiDrawCount,_t=De?M.get(De).bytesPerElement:1,as=Ge.get(q).currentProgram.getUniforms();for(let ln=0;ln<an;ln++)as.setValue(O,"_gl_DrawID",ln),Rt.render(_n[ln]/_t,Oe[ln])}else if($.isInstancedMesh)Rt.renderInstances(ke,Zt,$.count);else if(K.isInstancedBufferGeometry){let _n=K._maxInstanceCount!==void 0?K._maxInstanceCount:1/0,Oe=Math.min(K.instanceCount,_n);Rt.renderInstances(ke,Zt,Oe)}else Rt.render(ke,Zt)};function No(A,B,K,q){z!==null&&A.isNodeMaterial&&z.setObject(q,A),Bt===!0&&oe.setState(A,K,!1),A.transparent===!0&&A.side===Si&&A.forceSinglePass===!1?(A.side=pn,A.needsUpdate=!0,ki(A,B,q),A.side=yi,A.needsUpdate=!0,ki(A,B,q),A.side=Si):ki(A,B,q)}this.compile=function(A,B,K=null){K===null&&(K=A),z!==null&&z.renderStart(A,B,K),E=ie.get(K),E.init(B),b.push(E),K.traverseVisible(function($){$.isLight&&$.layers.test(B.layers)&&(E.pushLight($),$.castShadow&&E.pushShadow($))}),A!==K&&A.traverseVisible(function($){$.isLight&&$.layers.test(B.layers)&&(E.pushLight($),$.castShadow&&E.pushShadow($))}),E.setupLights(),z!==null&&z.updateLights(E.state.lightsArray),rn=this.localClippingEnabled,Bt=oe.init(this.clippingPlanes,rn),Bt===!0&&oe.setGlobalState(this.clippingPlanes,B),z!==null&&ge.render(E.state.shadowsArray,K,B);let q=new Set;return A.traverse(function($){if(!($.isMesh||$.isPoints||$.isLine||$.isSprite))return;let Ee=$.material;if(Ee)if(Array.isArray(Ee))for(let Le=0;Le<Ee.length;Le++){let Ce=Ee[Le];No(Ce,K,B,$),q.add(Ce)}else No(Ee,K,B,$),q.add(Ee)}),E=b.pop(),z!==null&&z.renderEnd(),q},this.compileAsync=function(A,B,K=null){let q=this.compile(A,B,K);return new Promise($=>{function Ee(){if(q.forEach(function(Le){let De=Ge.get(Le).currentProgram;(De===void 0||De.isReady())&&q.delete(Le)}),q.size===0){$(A);return}setTimeout(Ee,10)}Ze.get("KHR_parallel_shader_compile")!==null?Ee():setTimeout(Ee,10)})};let Rr=null;function Bh(A){Rr&&Rr(A)}function Xa(){rs.stop()}function zi(){rs.start()}let rs=new wm;rs.setAnimationLoop(Bh),typeof self<"u"&&rs.setContext(self),this.setAnimationLoop=function(A){Rr=A,ue.setAnimationLoop(A),A===null?rs.stop():rs.start()},ue.addEventListener("sessionstart",Xa),ue.addEventListener("sessionend",zi),this.render=function(A,B){if(B!==void 0&&B.isCamera!==!0){et("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(P===!0)return;z!==null&&z.renderStart(A,B);let K=ue.enabled===!0&&ue.isPresenting===!0,q=U!==null&&(he===null||K)&&U.begin(D,he);if(A.matrixWorldAutoUpdate===!0&&A.updateMatrixWorld(),B.parent===null&&B.matrixWorldAutoUpdate===!0&&B.updateMatrixWorld(),ue.enabled===!0&&ue.isPresenting===!0&&(U===null||U.isCompositing()===!1)&&(ue.cameraAutoUpdate===!0&&ue.updateCamera(B),B=ue.getCamera()),A.isScene===!0&&A.onBeforeRender(D,A,B,he),E=ie.get(A,b.length),E.init(B),E.state.textureUnits=$e.getTextureUnits(),b.push(E),Dt.multiplyMatrices(B.projectionMatrix,B.matrixWorldInverse),B.isArrayCamera?Yt.setFromArrayCamera(B):it.setFromProjectionMatrix(Dt,xi,B.reversedDepth),rn=this.localClippingEnabled,Bt=oe.init(this.clippingPlanes,rn),C=Se.get(A,_.length),C.init(),_.push(C),this.info.render.frame++,ue.enabled===!0&&ue.isPresenting===!0){let Le=D.xr.getDepthSensingMesh();Le!==null&&os(Le,B,-1/0,D.sortObjects)}os(A,B,0,D.sortObjects),C.finish(),z!==null&&z.updateLights(E.state.lightsArray),D.sortObjects===!0&&C.sort(qe,rt),Jt=ue.enabled===!1||ue.isPresenting===!1||ue.hasDepthSensing()===!1,Jt&&F.addToRenderList(C,A),this.info.autoReset===!0&&this.info.reset(),Bt===!0&&oe.beginShadows();let $=E.state.shadowsArray;if(ge.render($,A,B),Bt===!0&&oe.endShadows(),(q&&U.hasRenderPass())===!1){let Le=C.opaque,Ce=C.transmissive;if(E.setupLights(),B.isArrayCamera){let De=B.cameras;if(Ce.length>0)for(let Ve=0,tt=De.length;Ve<tt;Ve++){let dt=De[Ve];Ai(Le,Ce,A,dt)}Jt&&F.render(A);for(let Ve=0,tt=De.length;Ve<tt;Ve++){let dt=De[Ve];Uo(C,A,dt,dt.viewport)}}else Ce.length>0&&Ai(Le,Ce,A,B),Jt&&F.render(A),Uo(C,A,B)}he!==null&&k===0&&($e.updateMultisampleRenderTarget(he),$e.updateRenderTargetMipmap(he)),q&&U.end(D),A.isScene===!0&&A.onAfterRender(D,A,B),be.resetDefaultState(),Y=-1,Q=null,b.pop(),b.length>0?(E=b[b.length-1],$e.setTextureUnits(E.state.textureUnits),Bt===!0&&oe.setGlobalState(D.clippingPlanes,E.state.camera)):E=null,_.pop(),_.length>0?C=_[_.length-1]:C=null,z!==null&&z.renderEnd()};function os(A,B,K,q){if(A.visible===!1)return;if(A.layers.test(B.layers)){if(A.isGroup)K=A.renderOrder;else if(A.isLOD)A.autoUpdate===!0&&A.update(B);else if(A.isLight)E.pushLight(A),A.castShadow&&E.pushShadow(A);else if(A.isSprite){let Le=B.isArrayCamera?Yt:it;if(!A.frustumCulled||A.intersectsFrustum(Le)){q&&St.setFromMatrixPosition(A.matrixWorld).applyMatrix4(Dt);let Ce=fe.update(A),De=A.material;De.visible&&C.push(A,Ce,De,K,St.z,null,B)}}else if(A.isMesh||A.isLine||A.isPoints){let Le=B.isArrayCamera?Yt:it;if(!A.frustumCulled||A.intersectsFrustum(Le)){let Ce=fe.update(A),De=A.material;if(q&&(A.boundingSphere!==void 0?(A.boundingSphere===null&&A.computeBoundingSphere(),St.copy(A.boundingSphere.center)):(Ce.boundingSphere===null&&Ce.computeBoundingSphere(),St.copy(Ce.boundingSphere.center)),St.applyMatrix4(A.matrixWorld).applyMatrix4(Dt)),Array.isArray(De)){let Ve=Ce.groups;for(let tt=0,dt=Ve.length;tt<dt;tt++){let ke=Ve[tt],pt=De[ke.materialIndex];pt&&pt.visible&&C.push(A,Ce,pt,K,St.z,ke,B)}}else De.visible&&C.push(A,Ce,De,K,St.z,null,B)}}}let Ee=A.children;for(let Le=0,Ce=Ee.length;Le<Ce;Le++)os(Ee[Le],B,K,q)}function Uo(A,B,K,q){let{opaque:$,transmissive:Ee,transparent:Le}=A;E.setupLightsView(K),Bt===!0&&oe.setGlobalState(D.clippingPlanes,K),q&&Ae.viewport(ne.copy(q)),$.length>0&&Kt($,B,K),Ee.length>0&&Kt(Ee,B,K),Le.length>0&&Kt(Le,B,K),Ae.buffers.depth.setTest(!0),Ae.buffers.depth.setMask(!0),Ae.buffers.color.setMask(!0),Ae.setPolygonOffset(!1)}function Ai(A,B,K,q){if((K.isScene===!0?K.overrideMaterial:null)!==null)return;if(E.state.transmissionRenderTarget[q.id]===void 0){let ke=Ze.has("EXT_color_buffer_half_float")||Ze.has("EXT_color_buffer_float");E.state.transmissionRenderTarget[q.id]=new ri(1,1,{generateMipmaps:!0,type:ke?Ui:li,minFilter:vs,samples:Math.max(4,ot.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:mt.workingColorSpace})}let Ee=E.state.transmissionRenderTarget[q.id],Le=q.viewport||ne;Ee.setSize(Le.z*D.transmissionResolutionScale,Le.w*D.transmissionResolutionScale);let Ce=D.getRenderTarget(),De=D.getActiveCubeFace(),Ve=D.getActiveMipmapLevel();D.setRenderTarget(Ee),D.getClearColor(ee),_e=D.getClearAlpha(),_e<1&&D.setClearColor(16777215,.5),D.clear(),Jt&&F.render(K);let tt=D.toneMapping;D.toneMapping=Ki;let dt=q.viewport;if(q.viewport!==void 0&&(q.viewport=void 0),E.setupLightsView(q),Bt===!0&&oe.setGlobalState(D.clippingPlanes,q),Kt(A,K,q),$e.updateMultisampleRenderTarget(Ee),$e.updateRenderTargetMipmap(Ee),Ze.has("WEBGL_multisampled_render_to_texture")===!1){let ke=!1;for(let pt=0,Zt=B.length;pt<Zt;pt++){let Ct=B[pt],{object:Rt,geometry:_n,material:Oe,group:an}=Ct;if(Oe.side===Si&&Rt.layers.test(q.layers)){let _t=Oe.side;Oe.side=pn,Oe.needsUpdate=!0,nn(Rt,K,q,_n,Oe,an),Oe.side=_t,Oe.needsUpdate=!0,ke=!0}}ke===!0&&($e.updateMultisampleRenderTarget(Ee),$e.updateRenderTargetMipmap(Ee))}D.setRenderTarget(Ce,De,Ve),D.setClearColor(ee,_e),dt!==void 0&&(q.viewport=dt),D.toneMapping=tt}function Kt(A,B,K){let q=B.isScene===!0?B.overrideMaterial:null;for(let $=0,Ee=A.length;$<Ee;$++){let Le=A[$],{object:Ce,geometry:De,group:Ve}=Le,tt=Le.material;tt.allowOverride===!0&&q!==null&&(tt=q),Ce.layers.test(K.layers)&&nn(Ce,B,K,De,tt,Ve)}}function nn(A,B,K,q,$,Ee){z!==null&&$.isNodeMaterial&&z.setObject(A,$),A.onBeforeRender(D,B,K,q,$,Ee),A.modelViewMatrix.multiplyMatrices(K.matrixWorldInverse,A.matrixWorld),A.normalMatrix.getNormalMatrix(A.modelViewMatrix),$.onBeforeRender(D,B,K,q,A,Ee),$.transparent===!0&&$.side===Si&&$.forceSinglePass===!1?($.side=pn,$.needsUpdate=!0,D.renderBufferDirect(K,B,q,$,A,Ee),$.side=yi,$.needsUpdate=!0,D.renderBufferDirect(K,B,q,$,A,Ee),$.side=Si):D.renderBufferDirect(K,B,q,$,A,Ee),A.onAfterRender(D,B,K,q,$,Ee)}function sn(A){let B=0;for(let K of A)K.texture!==null&&B++;return B}function ki(A,B,K){B.isScene!==!0&&(B=gn);let q=Ge.get(A),$=E.state.lights,Ee=E.state.shadowsArray,Le=$.state.version,Ce=le.getParameters(A,$.state,Ee,B,K,E.state.lightProbeGridArray),De=le.getProgramCacheKey(Ce),Ve=q.programs;q.environment=A.isMeshStandardMaterial||A.isMeshLambertMaterial||A.isMeshPhongMaterial?B.environment:null,q.fog=B.fog;let tt=A.isMeshStandardMaterial||A.isMeshLambertMaterial&&!A.envMap||A.isMeshPhongMaterial&&!A.envMap;q.envMap=R.get(A.envMap||q.environment,tt),q.envMapRotation=q.environment!==null&&A.envMap===null?B.environmentRotation:A.envMapRotation,Ve===void 0&&(A.addEventListener("dispose",at),Ve=new Map,q.programs=Ve,q.programVariants=new Map);let dt=Ve.get(De);if(dt!==void 0){if(q.currentProgram===dt&&q.lightsStateVersion===Le)return Fo(A,Ce),dt}else Ce.uniforms=le.getUniforms(A),z!==null&&A.isNodeMaterial&&z.build(A,K,Ce),A.onBeforeCompile(Ce,D),dt=le.acquireProgram(Ce,De),Ve.set(De,dt),q.uniforms=Ce.uniforms;let ke=q.uniforms;return(!A.isShaderMaterial&&!A.isRawShaderMaterial||A.clipping===!0)&&(ke.clippingPlanes=oe.uniform),Fo(A,Ce),q.needsLights=Ts(A),q.lightsStateVersion=Le,q.needsLights&&(ke.ambientLightColor.value=$.state.ambient,ke.lightProbe.value=$.state.probe,ke.sunLights.value=$.state.sun,ke.sunLightShadows.value=$.state.sunShadow,ke.directionalLights.value=$.state.directional,ke.directionalLightShadows.value=$.state.directionalShadow,ke.spotLights.value=$.state.spot,ke.spotLightShadows.value=$.state.spotShadow,ke.rectAreaLights.value=$.state.rectArea,ke.ltc_1.value=$.state.rectAreaLTC1,ke.ltc_2.value=$.state.rectAreaLTC2,ke.pointLights.value=$.state.point,ke.pointLightShadows.value=$.state.pointShadow,ke.hemisphereLights.value=$.state.hemi,ke.sunShadowMatrix.value=$.state.sunShadowMatrix,ke.sunShadowCascade.value=$.state.sunShadowCascade,ke.directionalShadowMatrix.value=$.state.directionalShadowMatrix,ke.spotLightMatrix.value=$.state.spotLightMatrix,ke.spotLightMap.value=$.state.spotLightMap,ke.pointShadowMatrix.value=$.state.pointShadowMatrix),q.numLightProbeGrids=sn(E.state.lightProbeGridArray),q.currentProgram=dt,q.uniformsList=null,dt}function jn(A,B,K,q,$){let Ee=Ge.get(A),Le=Ee.currentProgram.id+","+q+","+$,Ce=Ee.programVariants.get(Le);return Ce===void 0?(Ce=ki(A,B,K),Ee.programVariants.set(Le,Ce)):(Ee.currentProgram=Ce,Ee.uniformsList=null,Ee.outputColorSpace=q,Ee.toneMapping=$),Ce}function As(A){if(A.uniformsList===null){let B=A.currentProgram.getUniforms();A.uniformsList=po.seqWithValue(B.seq,A.uniforms)}return A.uniformsList}function Fo(A,B){let K=Ge.get(A);K.outputColorSpace=B.outputColorSpace,K.batching=B.batching,K.batchingColor=B.batchingColor,K.instancing=B.instancing,K.instancingColor=B.instancingColor,K.instancingMorph=B.instancingMorph,K.skinning=B.skinning,K.morphTargets=B.morphTargets,K.morphNormals=B.morphNormals,K.morphColors=B.morphColors,K.morphTargetsCount=B.morphTargetsCount,K.numClippingPlanes=B.numClippingPlanes,K.numIntersection=B.numClipIntersection,K.vertexAlphas=B.vertexAlphas,K.vertexTangents=B.vertexTangents,K.toneMapping=B.toneMapping}function Oo(A,B,K,q,$){B.isScene!==!0&&(B=gn),$e.resetTextureUnits();let Ee=B.fog,Le=q.isMeshStandardMaterial||q.isMeshLambertMaterial||q.isMeshPhongMaterial?B.environment:null,Ce=he===null?D.outputColorSpace:he.isXRRenderTarget===!0?he.texture.colorSpace:mt.workingColorSpace,De=q.isMeshStandardMaterial||q.isMeshLambertMaterial&&!q.envMap||q.isMeshPhongMaterial&&!q.envMap,Ve=R.get(q.envMap||Le,De),tt=q.vertexColors===!0&&!!K.attributes.color&&K.attributes.color.itemSize===4,dt=!!K.attributes.tangent&&(!!q.normalMap||q.anisotropy>0),ke=!!K.morphAttributes.position,pt=!!K.morphAttributes.normal,Zt=!!K.morphAttributes.color,Ct=Ki;q.toneMapped&&(he===null||he.isXRRenderTarget===!0)&&(Ct=D.toneMapping);let Rt=K.morphAttributes.position||K.morphAttributes.normal||K.morphAttributes.color,_n=Rt!==void 0?Rt.length:0,Oe=Ge.get(q),an=E.state.lights;if(Bt===!0&&(rn===!0||A!==Q)){let Pt=A===Q&&q.id===Y;oe.setState(q,A,Pt)}let _t=!1,as=!1;q.version===Oe.__version?Oe.needsLights&&Oe.lightsStateVersion!==an.state.version||$.isBatchedMesh&&Oe.batching===!1||!$.isBatchedMesh&&Oe.batching===!0||$.isBatchedMesh&&Oe.batchingColor===!0&&$._colorsTexture===null||$.isBatchedMesh&&Oe.batchingColor===!1&&$._colorsTexture!==null||$.isInstancedMesh&&Oe.instancing===!1||!$.isInstancedMesh&&Oe.instancing===!0||$.isSkinnedMesh&&Oe.skinning===!1||!$.isSkinnedMesh&&Oe.skinning===!0||$.isInstancedMesh&&Oe.instancingColor===!0&&$.instanceColor===null||$.isInstancedMesh&&Oe.instancingColor===!1&&$.instanceColor!==null||$.isInstancedMesh&&Oe.instancingMorph===!0&&$.morphTexture===null||$.isInstancedMesh&&Oe.instancingMorph===!1&&$.morphTexture!==null||Oe.envMap!==Ve||q.fog===!0&&Oe.fog!==Ee||Oe.numClippingPlanes!==void 0&&(Oe.numClippingPlanes!==oe.numPlanes||Oe.numIntersection!==oe.numIntersection)||Oe.vertexAlphas!==tt||Oe.vertexTangents!==dt||Oe.morphTargets!==ke||Oe.morphNormals!==pt||Oe.morphColors!==Zt||Oe.morphTargetsCount!==_n||Oe.numLightProbeGrids!==sn(E.state.lightProbeGridArray)?_t=!0:(Oe.outputColorSpace!==Ce||Oe.toneMapping!==Ct)&&(as=!0):(_t=!0,Oe.__version=q.version);let ln=Oe.currentProgram;(_t===!0||as===!0)&&(ln=as===!0?jn(q,B,$,Ce,Ct):ki(q,B,$),z&&q.isNodeMaterial&&z.onUpdateProgram(q,ln,Oe));let Lr=!1,Vi=!1,ls=!1,ct=ln.getUniforms(),jt=Oe.uniforms;if(Ae.useProgram(ln.program)&&(Lr=!0,Vi=!0,ls=!0),q.id!==Y&&(Y=q.id,Vi=!0),Lr||Q!==A){Ae.buffers.depth.getReversed()&&A.reversedDepth!==!0&&(A._reversedDepth=!0,A.updateProjectionMatrix()),ct.setValue(O,"projectionMatrix",A.projectionMatrix),ct.setValue(O,"viewMatrix",A.matrixWorldInverse);let cn=ct.map.cameraPosition;cn!==void 0&&cn.setValue(O,An.setFromMatrixPosition(A.matrixWorld)),ot.logarithmicDepthBuffer&&ct.setValue(O,"logDepthBufFC",2/(Math.log(A.far+1)/Math.LN2)),(q.isMeshPhongMaterial||q.isMeshToonMaterial||q.isMeshLambertMaterial||q.isMeshBasicMaterial||q.isMeshStandardMaterial||q.isShaderMaterial)&&ct.setValue(O,"isOrthographic",A.isOrthographicCamera===!0),Q!==A&&(Q=A,Vi=!0,ls=!0)}if(Oe.needsLights&&(an.state.sunShadowMap.length>0&&ct.setValue(O,"sunShadowMap",an.state.sunShadowMap,$e),an.state.directionalShadowMap.length>0&&ct.setValue(O,"directionalShadowMap",an.state.directionalShadowMap,$e),an.state.spotShadowMap.length>0&&ct.setValue(O,"spotShadowMap",an.state.spotShadowMap,$e),an.state.pointShadowMap.length>0&&ct.setValue(O,"pointShadowMap",an.state.pointShadowMap,$e)),$.isSkinnedMesh){ct.setOptional(O,$,"bindMatrix"),ct.setOptional(O,$,"bindMatrixInverse");let Pt=$.skeleton;Pt&&(Pt.boneTexture===null&&Pt.computeBoneTexture(),ct.setValue(O,"boneTexture",Pt.boneTexture,$e))}$.isBatchedMesh&&(ct.setOptional(O,$,"batchingTexture"),ct.setValue(O,"batchingTexture",$._matricesTexture,$e),ct.setOptional(O,$,"batchingIdTexture"),ct.setValue(O,"batchingIdTexture",$._indirectTexture,$e),ct.setOptional(O,$,"batchingColorTexture"),$._colorsTexture!==null&&ct.setValue(O,"batchingColorTexture",$._colorsTexture,$e));let kn=K.morphAttributes;if((kn.position!==void 0||kn.normal!==void 0||kn.color!==void 0)&&ae.update($,K,ln),(Vi||Oe.receiveShadow!==$.receiveShadow)&&(Oe.receiveShadow=$.receiveShadow,ct.setValue(O,"receiveShadow",$.receiveShadow)),(q.isMeshStandardMaterial||q.isMeshLambertMaterial||q.isMeshPhongMaterial)&&q.envMap===null&&B.environment!==null&&(jt.envMapIntensity.value=B.environmentIntensity),jt.dfgLUT!==void 0&&(jt.dfgLUT.value=FM()),Vi){if(ct.setValue(O,"toneMappingExposure",D.toneMappingExposure),Oe.needsLights&&Pr(jt,ls),Ee&&q.fog===!0&&ve.refreshFogUniforms(jt,Ee),ve.refreshMaterialUniforms(jt,q,we,Re,E.state.transmissionRenderTarget[A.id]),Oe.needsLights&&Oe.numLightProbeGrids>0){let Pt=S,cn=0;for(let Nn of E.state.lightProbeGridArray)Nn.texture!==null&&(Pt.textures[cn]=Nn.texture,Pt.min[cn]=Nn.boundingBox.min,Pt.max[cn]=Nn.boundingBox.max,Pt.resolution[cn]=Nn.resolution,cn++);for(let Nn in Pt)Pt[Nn].length=cn;jt.probesSH.value=Pt.textures,jt.probesMin.value=Pt.min,jt.probesMax.value=Pt.max,jt.probesResolution.value=Pt.resolution}po.upload(O,As(Oe),jt,$e)}if(q.isShaderMaterial&&q.uniformsNeedUpdate===!0&&(po.upload(O,As(Oe),jt,$e),q.uniformsNeedUpdate=!1),q.isSpriteMaterial&&ct.setValue(O,"center",$.center),ct.setValue(O,"modelViewMatrix",$.modelViewMatrix),ct.setValue(O,"normalMatrix",$.normalMatrix),ct.setValue(O,"modelMatrix",$.matrixWorld),q.uniformsGroups!==void 0){let Pt=q.uniformsGroups;for(let cn=0,Nn=Pt.length;cn<Nn;cn++){let qa=Pt[cn];Xe.update(qa,ln),Xe.bind(qa,ln)}}return ln}function Pr(A,B){A.ambientLightColor.needsUpdate=B,A.lightProbe.needsUpdate=B,A.sunLights.needsUpdate=B,A.sunLightShadows.needsUpdate=B,A.directionalLights.needsUpdate=B,A.directionalLightShadows.needsUpdate=B,A.pointLights.needsUpdate=B,A.pointLightShadows.needsUpdate=B,A.spotLights.needsUpdate=B,A.spotLightShadows.needsUpdate=B,A.rectAreaLights.needsUpdate=B,A.hemisphereLights.needsUpdate=B}function Ts(A){return A.isMeshLambertMaterial||A.isMeshToonMaterial||A.isMeshPhongMaterial||A.isMeshStandardMaterial||A.isShadowMaterial||A.isShaderMaterial&&A.lights===!0}this.getActiveCubeFace=function(){return Z},this.getActiveMipmapLevel=function(){return k},this.getRenderTarget=function(){return he},this.setRenderTargetTextures=function(A,B,K){let q=Ge.get(A);q.__autoAllocateDepthBuffer=A.resolveDepthBuffer===!1,q.__autoAllocateDepthBuffer===!1&&(q.__useRenderToTexture=!1),Ge.get(A.texture).__webglTexture=B,Ge.get(A.depthTexture).__webglTexture=q.__autoAllocateDepthBuffer?void 0:K,q.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(A,B){let K=Ge.get(A);K.__webglFramebuffer=B,K.__useDefaultFramebuffer=B===void 0},this.setRenderTarget=function(A,B=0,K=0){he=A,Z=B,k=K;let q=null,$=!1,Ee=!1;if(A){let Ce=Ge.get(A);if(Ce.__useDefaultFramebuffer!==void 0){Ae.bindFramebuffer(O.FRAMEBUFFER,Ce.__webglFramebuffer),ne.copy(A.viewport),de.copy(A.scissor),pe=A.scissorTest,Ae.viewport(ne),Ae.scissor(de),Ae.setScissorTest(pe),Y=-1;return}else if(Ce.__webglFramebuffer===void 0)$e.setupRenderTarget(A);else if(Ce.__hasExternalTextures)$e.rebindTextures(A,Ge.get(A.texture).__webglTexture,Ge.get(A.depthTexture).__webglTexture);else if(A.depthBuffer){let tt=A.depthTexture;if(Ce.__boundDepthTexture!==tt){if(tt!==null&&Ge.has(tt)&&(A.width!==tt.image.width||A.height!==tt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");$e.setupDepthRenderbuffer(A)}}let De=A.texture;(De.isData3DTexture||De.isDataArrayTexture||De.isCompressedArrayTexture)&&(Ee=!0);let Ve=Ge.get(A).__webglFramebuffer;A.isWebGLCubeRenderTarget?(Array.isArray(Ve[B])?q=Ve[B][K]:q=Ve[B],$=!0):A.samples>0&&$e.useMultisampledRTT(A)===!1?q=Ge.get(A).__webglMultisampledFramebuffer:Array.isArray(Ve)?q=Ve[K]:q=Ve,ne.copy(A.viewport),de.copy(A.scissor),pe=A.scissorTest}else ne.copy(We).multiplyScalar(we).floor(),de.copy(ft).multiplyScalar(we).floor(),pe=lt;if(K!==0&&(q=V),Ae.bindFramebuffer(O.FRAMEBUFFER,q)&&Ae.drawBuffers(A,q),Ae.viewport(ne),Ae.scissor(de),Ae.setScissorTest(pe),$){let Ce=Ge.get(A.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_CUBE_MAP_POSITIVE_X+B,Ce.__webglTexture,K)}else if(Ee){let Ce=B;for(let De=0;De<A.textures.length;De++){let Ve=Ge.get(A.textures[De]);O.framebufferTextureLayer(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0+De,Ve.__webglTexture,K,Ce)}}else if(A!==null&&K!==0){let Ce=Ge.get(A.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,Ce.__webglTexture,K)}Y=-1};function Ir(A){let B=Ge.get(A);return(B.__readFormat!==A.format||B.__readType!==A.type)&&(B.__readFormat=A.format,B.__readType=A.type,B.__formatReadable=ot.textureFormatReadable(A.format),B.__typeReadable=ot.textureTypeReadable(A.type)),B}this.readRenderTargetPixels=function(A,B,K,q,$,Ee,Le,Ce=0){if(!(A&&A.isWebGLRenderTarget)){et("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let De=Ge.get(A).__webglFramebuffer;if(A.isWebGLCubeRenderTarget&&Le!==void 0&&(De=De[Le],Array.isArray(De)&&(De=De[0])),De){Ae.bindFramebuffer(O.FRAMEBUFFER,De);try{let Ve=A.textures[Ce],tt=Ve.format,dt=Ve.type;A.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+Ce);let ke=Ir(Ve);if(ke.__formatReadable===!1){et("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(ke.__typeReadable===!1){et("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}B>=0&&B<=A.width-q&&K>=0&&K<=A.height-$&&O.readPixels(B,K,q,$,xe.convert(tt),xe.convert(dt),Ee)}finally{let Ve=he!==null?Ge.get(he).__webglFramebuffer:null;Ae.bindFramebuffer(O.FRAMEBUFFER,Ve)}}},this.readRenderTargetPixelsAsync=async function(A,B,K,q,$,Ee,Le,Ce=0){if(!(A&&A.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let De=Ge.get(A).__webglFramebuffer;if(A.isWebGLCubeRenderTarget&&Le!==void 0&&(De=De[Le],Array.isArray(De)&&(De=De[0])),De)if(B>=0&&B<=A.width-q&&K>=0&&K<=A.height-$){Ae.bindFramebuffer(O.FRAMEBUFFER,De);let Ve=A.textures[Ce],tt=Ve.format,dt=Ve.type;A.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+Ce);let ke=Ir(Ve);if(ke.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(ke.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let pt=O.createBuffer();O.bindBuffer(O.PIXEL_PACK_BUFFER,pt),O.bufferData(O.PIXEL_PACK_BUFFER,Ee.byteLength,O.STREAM_READ),O.readPixels(B,K,q,$,xe.convert(tt),xe.convert(dt),0),O.bindBuffer(O.PIXEL_PACK_BUFFER,null);let Zt=he!==null?Ge.get(he).__webglFramebuffer:null;Ae.bindFramebuffer(O.FRAMEBUFFER,Zt);let Ct=O.fenceSync(O.SYNC_GPU_COMMANDS_COMPLETE,0);return O.flush(),await $p(O,Ct,4),O.bindBuffer(O.PIXEL_PACK_BUFFER,pt),O.getBufferSubData(O.PIXEL_PACK_BUFFER,0,Ee),O.bindBuffer(O.PIXEL_PACK_BUFFER,null),O.deleteBuffer(pt),O.deleteSync(Ct),Ee}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(A,B=null,K=0){let q=Math.pow(2,-K),$=Math.floor(A.image.width*q),Ee=Math.floor(A.image.height*q),Le=B!==null?B.x:0,Ce=B!==null?B.y:0;$e.setTexture2D(A,0),O.copyTexSubImage2D(O.TEXTURE_2D,K,0,0,Le,Ce,$,Ee),Ae.unbindTexture()},this.copyTextureToTexture=function(A,B,K=null,q=null,$=0,Ee=0){let Le,Ce,De,Ve,tt,dt,ke,pt,Zt,Ct=A.isCompressedTexture?A.mipmaps[Ee]:A.image;if(K!==null)Le=K.max.x-K.min.x,Ce=K.max.y-K.min.y,De=K.isBox3?K.max.z-K.min.z:1,Ve=K.min.x,tt=K.min.y,dt=K.isBox3?K.min.z:0;else{let ct=Math.pow(2,-$);Le=Math.floor(Ct.width*ct),Ce=Math.floor(Ct.height*ct),A.isDataArrayTexture?De=Ct.depth:A.isData3DTexture?De=Math.floor(Ct.depth*ct):De=1,Ve=0,tt=0,dt=0}q!==null?(ke=q.x,pt=q.y,Zt=q.z):(ke=0,pt=0,Zt=0);let Rt=xe.convert(B.format),_n=xe.convert(B.type),Oe;B.isData3DTexture?($e.setTexture3D(B,0),Oe=O.TEXTURE_3D):B.isDataArrayTexture||B.isCompressedArrayTexture?($e.setTexture2DArray(B,0),Oe=O.TEXTURE_2D_ARRAY):($e.setTexture2D(B,0),Oe=O.TEXTURE_2D),Ae.activeTexture(O.TEXTURE0),Ae.pixelStorei(O.UNPACK_FLIP_Y_WEBGL,B.flipY),Ae.pixelStorei(O.UNPACK_PREMULTIPLY_ALPHA_WEBGL,B.premultiplyAlpha),Ae.pixelStorei(O.UNPACK_ALIGNMENT,B.unpackAlignment);let an=Ae.getParameter(O.UNPACK_ROW_LENGTH),_t=Ae.getParameter(O.UNPACK_IMAGE_HEIGHT),as=Ae.getParameter(O.UNPACK_SKIP_PIXELS),ln=Ae.getParameter(O.UNPACK_SKIP_ROWS),Lr=Ae.getParameter(O.UNPACK_SKIP_IMAGES);Ae.pixelStorei(O.UNPACK_ROW_LENGTH,Ct.width),Ae.pixelStorei(O.UNPACK_IMAGE_HEIGHT,Ct.height),Ae.pixelStorei(O.UNPACK_SKIP_PIXELS,Ve),Ae.pixelStorei(O.UNPACK_SKIP_ROWS,tt),Ae.pixelStorei(O.UNPACK_SKIP_IMAGES,dt);let Vi=A.isDataArrayTexture||A.isData3DTexture,ls=B.isDataArrayTexture||B.isData3DTexture;if(A.isDepthTexture){let ct=Ge.get(A),jt=Ge.get(B),kn=Ge.get(ct.__renderTarget),Pt=Ge.get(jt.__renderTarget);Ae.bindFramebuffer(O.READ_FRAMEBUFFER,kn.__webglFramebuffer),Ae.bindFramebuffer(O.DRAW_FRAMEBUFFER,Pt.__webglFramebuffer);for(let cn=0;cn<De;cn++)Vi&&(O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Ge.get(A).__webglTexture,$,dt+cn),O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Ge.get(B).__webglTexture,Ee,Zt+cn)),O.blitFramebuffer(Ve,tt,Ve+Le,tt+Ce,ke,pt,ke+Le,pt+Ce,O.DEPTH_BUFFER_BIT,O.NEAREST);Ae.bindFramebuffer(O.READ_FRAMEBUFFER,null),Ae.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else if($!==0||A.isRenderTargetTexture||Ge.has(A)){let ct=Ge.get(A),jt=Ge.get(B);Ae.bindFramebuffer(O.READ_FRAMEBUFFER,L),Ae.bindFramebuffer(O.DRAW_FRAMEBUFFER,H);for(let kn=0;kn<De;kn++)Vi?O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,ct.__webglTexture,$,dt+kn):O.framebufferTexture2D(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,ct.__webglTexture,$),ls?O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,jt.__webglTexture,Ee,Zt+kn):O.framebufferTexture2D(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,jt.__webglTexture,Ee),$!==0?O.blitFramebuffer(Ve,tt,Ve+Le,tt+Ce,ke,pt,ke+Le,pt+Ce,O.COLOR_BUFFER_BIT,O.NEAREST):ls?O.copyTexSubImage3D(Oe,Ee,ke,pt,Zt+kn,Ve,tt,Le,Ce):O.copyTexSubImage2D(Oe,Ee,ke,pt,Ve,tt,Le,Ce);Ae.bindFramebuffer(O.READ_FRAMEBUFFER,null),Ae.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else ls?A.isDataTexture||A.isData3DTexture?O.texSubImage3D(Oe,Ee,ke,pt,Zt,Le,Ce,De,Rt,_n,Ct.data):B.isCompressedArrayTexture?O.compressedTexSubImage3D(Oe,Ee,ke,pt,Zt,Le,Ce,De,Rt,Ct.data):O.texSubImage3D(Oe,Ee,ke,pt,Zt,Le,Ce,De,Rt,_n,Ct):A.isDataTexture?O.texSubImage2D(O.TEXTURE_2D,Ee,ke,pt,Le,Ce,Rt,_n,Ct.data):A.isCompressedTexture?O.compressedTexSubImage2D(O.TEXTURE_2D,Ee,ke,pt,Ct.width,Ct.height,Rt,Ct.data):O.texSubImage2D(O.TEXTURE_2D,Ee,ke,pt,Le,Ce,Rt,_n,Ct);Ae.pixelStorei(O.UNPACK_ROW_LENGTH,an),Ae.pixelStorei(O.UNPACK_IMAGE_HEIGHT,_t),Ae.pixelStorei(O.UNPACK_SKIP_PIXELS,as),Ae.pixelStorei(O.UNPACK_SKIP_ROWS,ln),Ae.pixelStorei(O.UNPACK_SKIP_IMAGES,Lr),Ee===0&&B.generateMipmaps===!0&&B.mipmapsAutoUpdate===!0&&O.generateMipmap(Oe),Ae.unbindTexture()},this.initRenderTarget=function(A){Ge.get(A).__webglFramebuffer===void 0&&$e.setupRenderTarget(A)},this.initTexture=function(A){A.isCubeTexture?$e.setTextureCube(A,0):A.isData3DTexture?$e.setTexture3D(A,0):A.isDataArrayTexture||A.isCompressedArrayTexture?$e.setTexture2DArray(A,0):$e.setTexture2D(A,0),Ae.unbindTexture()},this.resetState=function(){Z=0,k=0,he=null,Ae.reset(),be.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return xi}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=mt._getDrawingBufferColorSpace(e),t.unpackColorSpace=mt._getUnpackColorSpace()}};var mr=`
uniform vec4 haze;   // colour of the paper, and distance of the middle of the picture
vec3 hazed(vec3 lit, float distance, float most) { return mix(lit, haze.rgb, most * clamp((distance / haze.w - 1.0) / 0.6, 0.0, 1.0)); }`,Zc=`
uniform float darkness;
vec3 shade(vec3 base, vec3 normal, vec3 towards) {
  vec3 light = normalize(vec3(-0.35, 0.6, 0.72));
  float facing = clamp(dot(normal, towards), 0.0, 1.0);
  float diffuse = 0.5 + 0.5 * dot(normal, light);
  float bright = pow(clamp(dot(normal, normalize(light + towards)), 0.0, 1.0), 42.0);
  vec3 lit = base * (0.46 + 0.66 * diffuse * diffuse) + 0.22 * bright;
  // The rim contrasts with a white and with a black background.
  float rim = pow(1.0 - facing, 4.0);
  return mix(lit, darkness > 0.5 ? mix(lit, vec3(0.85, 0.92, 1.0), 0.6) : lit * 0.45, 0.8 * rim);
}`;var OM=`
// B·y, symmetric, from the components 111, 112, 113, 122 and 123, 222, 223.
mat3 along_mode(vec4 b, vec3 c, vec3 y) {
  float xzz = -b.x - b.w, yzz = -b.y - c.y, zzz = -b.z - c.z;
  float xy = b.y * y.x + b.w * y.y + c.x * y.z, xz = b.z * y.x + c.x * y.y + xzz * y.z, yz = c.x * y.x + c.z * y.y + yzz * y.z;
  return mat3(
    b.x * y.x + b.y * y.y + b.z * y.z, xy, xz,
    xy, b.w * y.x + c.y * y.y + c.z * y.z, yz,
    xz, yz, xzz * y.x + yzz * y.y + zzz * y.z);
}`,BM=`
precision highp float;
in vec2 position;
in vec3 place;
in vec4 row0, row1, row2;   // rows of F, in steps; the last of row0 is 1 if the body is shown
in float radius, value;
#ifdef QUADRATIC
in vec4 mode0, mode1;   // the components of B, in steps
uniform float modeStep;
flat out mat3 stretch, material;
flat out vec4 modeA;
flat out vec3 modeB;
#endif
uniform mat4 viewMatrix, projectionMatrix;
uniform float shapeStep, enlargement, pixel, smallest, chosen;
flat out vec3 eye, inverse0, inverse1, inverse2;
flat out float colourAt, isChosen;
out vec3 ray;

// Bounds of the cone of tangents, as x or y over -z: roots of a s² + 2 b s + c = 0.
vec2 bounds(vec3 across, vec3 depth, float at, float z) {
  float a = z * z - dot(depth, depth), b = at * z - dot(across, depth), c = at * at - dot(across, across);
  float root = sqrt(max(b * b - a * c, 0.0));
  return vec2(-b - root, -b + root) / a;
}

void main() {
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  if (row0.w < 0.5) return;
  mat3 F = transpose(mat3(row0.xyz, row1.xyz, row2.xyz)) * shapeStep;
  vec3 centre = (viewMatrix * vec4(place, 1.0)).xyz;
  float size = radius * enlargement;
  // Bodies below a size of one or two pixels are drawn as dots.
  float least = smallest * pixel * max(-centre.z, 0.0);
  float longest = size * sqrt(max(dot(F[0], F[0]), max(dot(F[1], F[1]), dot(F[2], F[2]))));
  mat3 G = longest < least ? mat3(least) : mat3(viewMatrix) * F * size;
  mat3 bounding = G;
#ifdef QUADRATIC
  mat3 turn = mat3(1.0), inverseV;
  modeA = vec4(0.0); modeB = vec3(0.0);
  if (longest >= least) {
    turn = F;
    // The rotation of F, by Newton's iteration.
    for (int k = 0; k < 12; k++) turn = 0.5 * (turn + transpose(inverse(turn)));
    modeA = mode0 * modeStep; modeB = mode1.xyz * modeStep;
    // The ellipsoid, so much larger, contains the surface: |B YY| is at most the amplitude.
    float xzz = modeA.x + modeA.w, yzz = modeA.y + modeB.y, zzz = modeA.z + modeB.z;
    float squares = modeA.x * modeA.x + modeB.y * modeB.y + zzz * zzz
      + 3.0 * (dot(modeA.yzw, modeA.yzw) + modeB.z * modeB.z + xzz * xzz + yzz * yzz) + 6.0 * modeB.x * modeB.x;
    inverseV = inverse(F);
    bounding = G * (1.0 + sqrt(0.4 * squares * (dot(inverseV[0], inverseV[0]) + dot(inverseV[1], inverseV[1]) + dot(inverseV[2], inverseV[2]))));
    G = mat3(viewMatrix) * size;
    stretch = F * transpose(turn);
  } else stretch = mat3(1.0);
  material = transpose(turn);
#endif
  vec3 depth = vec3(bounding[0].z, bounding[1].z, bounding[2].z);
  float reach = length(depth);
  if (centre.z - reach > 0.0) return;
  vec2 xs, ys;
  if (-centre.z <= reach * 1.001) {
    xs = (projectionMatrix[2][0] + vec2(-1.0, 1.0)) / projectionMatrix[0][0];
    ys = (projectionMatrix[2][1] + vec2(-1.0, 1.0)) / projectionMatrix[1][1];
  } else {
    xs = bounds(vec3(bounding[0].x, bounding[1].x, bounding[2].x), depth, centre.x, centre.z) + vec2(-1.5, 1.5) * pixel;
    ys = bounds(vec3(bounding[0].y, bounding[1].y, bounding[2].y), depth, centre.y, centre.z) + vec2(-1.5, 1.5) * pixel;
  }
  ray = vec3(position.x < 0.0 ? xs.x : xs.y, position.y < 0.0 ? ys.x : ys.y, -1.0);
  mat3 inverted = inverse(G);
  eye = -(inverted * centre);
  inverse0 = inverted[0]; inverse1 = inverted[1]; inverse2 = inverted[2];
  colourAt = value;
  isChosen = float(gl_InstanceID) == chosen ? 1.0 : 0.0;
  gl_Position = vec4((projectionMatrix * vec4(ray, 1.0)).xy, 0.0, 1.0);
}`,zM=`
precision highp float;
flat in vec3 eye, inverse0, inverse1, inverse2;
flat in float colourAt, isChosen;
in vec3 ray;
uniform mat4 projectionMatrix;
uniform sampler2D colours;
uniform float mark;
uniform vec3 accent, unknown;
out vec4 colour;
#ifdef QUADRATIC
flat in mat3 stretch, material;
flat in vec4 modeA;
flat in vec3 modeB;
${OM}
#endif
${Zc}${mr}

void main() {
  mat3 inverted = mat3(inverse0, inverse1, inverse2);
  vec3 along = inverted * ray;
  float square = dot(along, along), nearest = -dot(eye, along) / square;
  vec3 point = eye + nearest * along;
#ifdef QUADRATIC
  // Newton's iterations for the point of the ray whose image in the sphere is nearest to its centre, then for the
  // point where the image enters the sphere.
  mat3 inverseV = inverse(stretch), tangent = inverseV;
  vec3 speed = tangent * along;
  nearest = -dot(inverseV * eye, speed) / dot(speed, speed);
  point = inverseV * (eye + nearest * along);
  for (int k = 0; k < 6; k++) {
    mat3 half_slope = along_mode(modeA, modeB, point);
    tangent = inverse(stretch + 2.0 * half_slope);
    point += tangent * (eye + nearest * along - (stretch + half_slope) * point);
    speed = tangent * along;
    float bend = dot(speed, speed) - 2.0 * dot(point, tangent * (along_mode(modeA, modeB, speed) * speed));
    float change = -dot(point, speed) / max(bend, 0.3 * dot(speed, speed));
    nearest += change;
    point += change * speed;
    // Farther out the map folds.
    point *= min(1.0, 1.2 / length(point));
  }
  square = dot(speed, speed);
#endif
  float away = length(point);
#ifdef QUADRATIC
  vec3 residual = eye + nearest * along - (stretch + along_mode(modeA, modeB, point)) * point;
  if (dot(residual, residual) > 1e-3) away = 2.0;
#endif
  float blur = max(fwidth(away), 1e-6);
  float cover = clamp((1.0 - away) / blur + 0.5, 0.0, 1.0);
  if (cover <= 0.0) discard;
  float half_chord = sqrt(max(1.0 - away * away, 0.0) / square);
  float t = nearest - half_chord;
  if (nearest <= 0.0) discard;
#ifdef QUADRATIC
  point -= half_chord * speed;
  for (int k = 0; k < 5; k++) {
    mat3 half_slope = along_mode(modeA, modeB, point);
    tangent = inverse(stretch + 2.0 * half_slope);
    point += tangent * (eye + t * along - (stretch + half_slope) * point);
    speed = tangent * along;
    float change = 0.5 * (1.0 - dot(point, point)) / min(dot(point, speed), -1e-3 * sqrt(square));
    change = clamp(change, -0.5 * half_chord, 0.5 * half_chord);
    t += change;
    point += change * speed;
  }
  vec3 normal = normalize(transpose(tangent * inverted) * point);
  residual = eye + t * along - (stretch + along_mode(modeA, modeB, point)) * point;
  if (dot(residual, residual) > 1e-3) discard;
  point = normalize(material * point);
#else
  point = normalize(point - half_chord * along);
  vec3 normal = normalize(transpose(inverted) * point);
#endif
  float z = -t;
  float depth = (projectionMatrix[2][2] * z + projectionMatrix[3][2]) / -z;
  gl_FragDepth = clamp(0.5 * depth + 0.5, 0.0, 1.0);

  vec3 base = colourAt != colourAt || colourAt < -0.5 ? unknown : texture(colours, vec2((colourAt * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  if (mark > 0.5) {
    // Three great circles and a spot on the material.
    vec3 off = abs(point);
    float line = min(off.x, min(off.y, off.z)), soft = max(fwidth(line), 1e-5);
    float on = (1.0 - smoothstep(0.04 - soft, 0.04 + soft, line)) * min(1.0, 0.09 / soft);
    float spot = length(point - vec3(1.0, 0.0, 0.0)), softer = max(fwidth(spot), 1e-5);
    on = max(on, (1.0 - smoothstep(0.3 - softer, 0.3 + softer, spot)) * min(1.0, 0.6 / softer));
    float light = dot(base, vec3(0.3, 0.59, 0.11));
    base = mix(base, light > 0.45 ? base * 0.42 : mix(base, vec3(1.0), 0.62), 0.8 * on);
  }
  vec3 lit = shade(base, normal, normalize(-ray));
  lit = hazed(lit, -z, 0.3);
  // Outline of the selected body.
  if (isChosen > 0.5) lit = mix(lit, accent, smoothstep(1.0 - 4.5 * blur, 1.0 - 3.5 * blur, away));
  colour = vec4(lit, cover);
}`;function Um([i,e,t,n,s,r,o]){let a=i**2+r**2+(t+o)**2,l=e**2+t**2+n**2+o**2+(i+n)**2+(e+r)**2;return Math.sqrt(.4*(a+3*l+6*s**2))}var go=class{constructor(e,t){this.data=e;let n=e.n,s=new Gs;s.setAttribute("position",new Xt(new Float32Array([-1,-1,1,-1,1,1,-1,1]),2)),s.setIndex([0,1,2,0,2,3]),s.instanceCount=n,s.boundingSphere=new vi(new W,1);let r=(o,a,l)=>{let c=new na(a,l);return c.setUsage(Qu),s.setAttribute(o,c),c};this.place=r("place",new Float32Array(3*n),3),this.rows=[0,1,2].map(o=>r(`row${o}`,new Int16Array(4*n),4)),this.value=r("value",new Float32Array(n),1),r("radius",e.radius,1),this.modes=e.B?[0,1].map(o=>r(`mode${o}`,new Int16Array(4*n),4)):[],this.material=new oi({glslVersion:Mi,vertexShader:BM,fragmentShader:zM,defines:e.B?{QUADRATIC:1}:{},alphaToCoverage:!0,uniforms:{shapeStep:{value:e.shapeStep},modeStep:{value:e.modeStep},enlargement:{value:1},pixel:{value:.001},smallest:{value:1.4},chosen:{value:-1},mark:{value:1},colours:{value:null},accent:{value:new W},unknown:{value:new W(.6,.63,.66)},darkness:{value:0},haze:t}}),this.mesh=new vn(s,this.material),this.mesh.frustumCulled=!1,this.shown=new Uint8Array(n)}show(e,t,n){let{n:s,x:r,F:o,B:a}=this.data,[l,c]=this.modes.map(d=>d.array),f=this.place.array,u=this.value.array,[h,p,g]=this.rows.map(d=>d.array),v=0;f.set(r.subarray(3*s*e,3*s*(e+1)));for(let d=0;d<s;d++){let m=t(d);if(this.shown[d]=m?1:0,h[4*d+3]=this.shown[d],!m)continue;v++;let y=9*(s*e+d),T=4*d;if(h[T]=o[y],h[T+1]=o[y+1],h[T+2]=o[y+2],p[T]=o[y+3],p[T+1]=o[y+4],p[T+2]=o[y+5],g[T]=o[y+6],g[T+1]=o[y+7],g[T+2]=o[y+8],a){let S=7*(s*e+d);l.set(a.subarray(S,S+4),T),c.set(a.subarray(S+4,S+7),T)}u[d]=n(d)}for(let d of[this.place,...this.rows,...this.modes,this.value])d.needsUpdate=!0;return v}pick(e,t,n,s){let{n:r,x:o,F:a,radius:l,shapeStep:c}=this.data,{enlargement:f,smallest:u}=this.material.uniforms,h=1/0,p=-1;for(let g=0;g<r;g++){if(!this.shown[g])continue;let v=3*(r*e+g),d=9*(r*e+g),m=o[v]-t.x,y=o[v+1]-t.y,T=o[v+2]-t.z,S=m*n.x+y*n.y+T*n.z;if(S<=0)continue;let C=l[g]*f.value*c,E=0;for(let P=0;P<3;P++)E=Math.max(E,a[d+P]**2+a[d+P+3]**2+a[d+P+6]**2);E=Math.sqrt(E)*C;let _=Math.max(u.value,5)*s*S,b=m*m+y*y+T*T-S*S,U=Math.max(1.8*E,_);if(b>U*U)continue;let D;if(E<_){if(b>_*_)continue;D=S}else{let P=kM(a,d,C,m,y,T,n);if(P===null)continue;D=P}D<h&&(h=D,p=g)}return p}};function kM(i,e,t,n,s,r,o){let[a,l,c,f,u,h,p,g,v]=[0,1,2,3,4,5,6,7,8].map(z=>t*i[e+z]),d=a*(u*v-h*g)-l*(f*v-h*p)+c*(f*g-u*p);if(d===0)return null;let m=(z,V,L)=>[((u*v-h*g)*z+(c*g-l*v)*V+(l*h-c*u)*L)/d,((h*p-f*v)*z+(a*v-c*p)*V+(c*f-a*h)*L)/d,((f*g-u*p)*z+(l*p-a*g)*V+(a*u-l*f)*L)/d],[y,T,S]=m(o.x,o.y,o.z),[C,E,_]=m(n,s,r),b=y*y+T*T+S*S,U=y*C+T*E+S*_,D=C*C+E*E+_*_,P=U*U-b*(D-1);return P<0?null:(U-Math.sqrt(P))/b}var Fm=1.55,Jc=class{constructor(e,t,n,s,r){this.canvas=e,this.home=t,this.insets=n,this.camera=new Ln(t.angle,1,.01,10),this.onChange=s,this.onTap=r,this.pointers=new Map,this.up=new W(...t.up);let o=new W(...t.towards),a=o.clone().addScaledVector(this.up,-o.dot(this.up));this.front=a.length()>1e-6?a.normalize():new W(1,0,0).cross(this.up).normalize(),this.side=new W().crossVectors(this.up,this.front),this.homePitch=Math.asin(Math.max(-1,Math.min(1,o.dot(this.up)))),this.target=new W,this.listen()}resize(e,t){let n=this.fit;this.width=e,this.height=t,this.camera.aspect=e/t,this.fit=this.distanceFor(this.home.corners,this.home.leastWidth),n&&this.distance&&(this.distance*=this.fit/n),this.place()}free(){let[e,t]=this.insets;return{share:Math.max(.3,1-(e+t)/this.height),shift:(e-t)/2}}distanceFor(e,t){let n=Math.tan(this.home.angle*Math.PI/360),{aspect:s}=this.camera,{share:r}=this.free(),o=Math.max(...e.map(([,l])=>Math.abs(l))),a=Math.max(t,this.home.tall*o*s);return Math.max(...e.map(([l,c,f])=>f+this.home.margin*Math.max(Math.min(Math.abs(l),a)/(n*s),Math.abs(c)/(n*r))))}goHome(){this.yaw=0,this.pitch=this.homePitch,this.target.set(...this.home.focus),this.distance=this.fit,this.place()}look(e,t,n,s,r,o){Object.assign(this,{yaw:e,pitch:t,distance:n*this.fit}),this.target.set(s,r,o),this.place()}showAll(e){this.target.set(0,0,0);let{towards:t,right:n,up:s}=this.axes(),r=[];for(let o of[-1,1])for(let a of[-1,1])for(let l of[-1,1]){let c=new W(o*e[0],a*e[1],l*e[2]);r.push([c.dot(n),c.dot(s),c.dot(t)])}this.distance=this.distanceFor(r,1/0),this.place()}axes(){let e=this.towards(),t=new W().crossVectors(this.up,e).normalize();return{towards:e,right:t,up:new W().crossVectors(e,t)}}towards(){let e=Math.cos(this.pitch);return new W().addScaledVector(this.front,e*Math.cos(this.yaw)).addScaledVector(this.side,e*Math.sin(this.yaw)).addScaledVector(this.up,Math.sin(this.pitch))}place(){if(this.yaw===void 0||!this.width)return;let{towards:e,right:t,up:n}=this.axes(),s=this.camera;s.position.copy(this.target).addScaledVector(e,this.distance),s.quaternion.setFromRotationMatrix(new It().makeBasis(t,n,e)),s.near=Math.max(.02*this.distance,this.distance-4),s.far=this.distance+4;let{width:r,height:o}=this;s.setViewOffset(r,o,0,-this.free().shift,r,o),s.updateMatrixWorld(!0),this.onChange()}turn(e,t){this.yaw-=e,this.pitch=Math.max(-Fm,Math.min(Fm,this.pitch+t)),this.place()}move(e,t){let{right:n,up:s}=this.axes(),r=2*this.distance*Math.tan(this.home.angle*Math.PI/360)/this.height;this.target.addScaledVector(n,-e*r).addScaledVector(s,t*r),this.place()}zoom(e,t=this.width/2,n=this.height/2+this.free().shift){let s=this.distance;this.distance=Math.max(1e-6,Math.min(20,s*e));let r=this.distance/s-1;this.move((t-this.width/2)*r,(n-this.height/2-this.free().shift)*r)}listen(){let e=this.canvas,t=o=>{let a=e.getBoundingClientRect();return{x:o.clientX-a.left,y:o.clientY-a.top}};e.addEventListener("pointerdown",o=>{e.setPointerCapture(o.pointerId);let a=t(o);this.pointers.set(o.pointerId,{...a,moving:o.button!==0||o.shiftKey}),this.travelled=this.pointers.size>1?1/0:0}),e.addEventListener("pointermove",o=>{let a=this.pointers.get(o.pointerId);if(!a)return;let l=t(o),c=l.x-a.x,f=l.y-a.y;if(this.pointers.size===1){if(this.travelled+=Math.hypot(c,f),this.travelled<4)return;a.moving?this.move(c,f):this.turn(c*3.2/this.height,f*3.2/this.height)}else if(this.pointers.size===2){let[u]=[...this.pointers].filter(([g])=>g!==o.pointerId).map(([,g])=>g),h=Math.hypot(l.x-u.x,l.y-u.y),p=Math.hypot(a.x-u.x,a.y-u.y);h>0&&p>0&&this.zoom(p/h,(l.x+u.x)/2,(l.y+u.y)/2),this.move(c/2,f/2)}Object.assign(a,l)});let n=o=>{let a=this.pointers.get(o.pointerId);this.pointers.delete(o.pointerId),a&&o.type==="pointerup"&&this.travelled<4&&!a.moving&&this.onTap(t(o),o.pointerType)};e.addEventListener("pointerup",n),e.addEventListener("pointercancel",n),e.addEventListener("contextmenu",o=>o.preventDefault());let s=()=>window.parent!==window&&!document.hasFocus(),r=()=>{e.style.touchAction=s()?"pan-y":""};for(let o of["focus","blur"])addEventListener(o,r);r(),e.addEventListener("wheel",o=>{if(s()&&!o.ctrlKey)return;o.preventDefault();let a=o.deltaMode===1?16:1,l=t(o);this.zoom(Math.exp(Math.max(-.5,Math.min(.5,o.deltaY*a*.0012))),l.x,l.y)},{passive:!1})}};var Om=["#0072b2","#e69f00","#009e73","#cc79a7","#56b4e9","#d55e00","#f0e442","#8c8c8c"];function Ws(i){if(i<Om.length)return Om[i];let e=i*137.508%360,t=n=>{let s=((e/60+n)%6+6)%6,r=Math.max(0,Math.min(1,Math.min(s,4-s)));return Math.round(255*(.25+.5*r)).toString(16).padStart(2,"0")};return`#${t(2)}${t(0)}${t(4)}`}function Kc(i){return[1,3,5].map(e=>parseInt(i.slice(e,e+2),16))}function Bm(i){let e=new Uint8Array(1024);for(let t=0;t<256;t++){for(let n=0;n<3;n++)e[4*t+n]=parseInt(i.slice(6*t+2*n,6*t+2*n+2),16);e[4*t+3]=255}return e}function zm(i){let e=new Uint8Array(1024);for(let t=0;t<256;t++)e.set([...Kc(t<i?Ws(t):"#9aa3ab"),255],4*t);return e}var VM=[[1,""],[.001,"m"],[1e-6,"µ"],[1e-9,"n"]];function es(i,e){let t=Math.abs(e);if(!/^(m|s|m\/s|Pa|N)$/.test(i)||!(t>0)||t>=1e5)return{factor:1,unit:i};for(let[n,s]of VM)if(t>=.5*n)return{factor:n,unit:s+i};return{factor:1,unit:i}}function jc(i,e,t){let n=Math.max(Math.abs(e),Math.abs(t)),s=es(i,n),r=Math.floor(Math.log10(n/s.factor||1)),o=r<-2||r>3?r:0,a=s.factor*10**o,l=Math.min(Math.max(Math.ceil(1.5-Math.log10((t-e)/a)),0),4),c=f=>String(Number((f/a).toFixed(l))).replace("-","−");return{unit:[o?Vm(o):"",_o(s.unit)].filter(Boolean).join(" "),factor:a,text:c}}var km={"-":"⁻",0:"⁰",1:"¹",2:"²",3:"³",4:"⁴",5:"⁵",6:"⁶",7:"⁷",8:"⁸",9:"⁹"},Vm=i=>`10${[...String(i)].map(e=>km[e]).join("")}`;function tn(i,e=4){if(!Number.isFinite(i))return"unknown";if(i===0)return"0";let t=Math.abs(i);if(t>=.001&&t<1e5)return String(Number(i.toPrecision(e))).replace("-","−");let[n,s]=i.toExponential(e-1).split("e");return`${String(Number(n)).replace("-","−")} × ${Vm(Number(s))}`}function hi(i,e,t=i){let n=es(e,t);return`${tn(i/n.factor)}${n.unit?` ${_o(n.unit)}`:""}`}function _o(i){return i.replace(/(?<=[a-zA-Z])(-?\d)/g,e=>[...e].map(t=>km[t]).join(""))}function mf(i,e,t=5){let n=e-i;if(!(n>0))return[i];let s=n/(t-1),r=10**Math.floor(Math.log10(s)),o=[1,2,2.5,5,10].map(l=>l*r).find(l=>l>=s*(1-1e-9)),a=[i];for(let l=Math.ceil(i/o+1e-6);l*o<e-1e-6*n;l++)l*o-i>.6*o&&e-l*o>.6*o&&a.push(l*o);return a.push(e),a}var Qc=262,xo=118,Aa=48,gf=8,eh=22,_f=20,ts=(i,e,t)=>{let n=document.createElementNS("http://www.w3.org/2000/svg",i);for(let[s,r]of Object.entries(e))n.setAttribute(s,r);return t!==void 0&&(n.textContent=t),n};function Gm(i,{label:e,unit:t,times:n,values:s,now:r}){let o=s.filter(Number.isFinite);if(i.replaceChildren(),o.length===0)return;let a=o.reduce((S,C)=>Math.min(S,C)),l=o.reduce((S,C)=>Math.max(S,C));if(l-a<=2e-4*Math.max(Math.abs(a),Math.abs(l))){let S=Math.abs(l)*.05||1;a-=S,l+=S}else a>0&&a<.5*l&&(a=0);let c=jc(t,a,l),f=n.filter((S,C)=>Number.isFinite(s[C])),u=f[0],h=f[f.length-1],p=es("s",h),g=S=>Aa+(S-u)/(h-u||1)*(Qc-Aa-gf),v=S=>eh+(1-(S-a)/(l-a))*(xo-eh-_f),d=ts("svg",{viewBox:`0 0 ${Qc} ${xo}`,role:"img"}),m=c.unit?`${e} (${c.unit})`:e;d.append(ts("title",{},`${m} over time, from ${c.text(o[0])} to ${c.text(o[o.length-1])}`)),d.append(ts("text",{class:"name",x:0,y:12},m)),d.append(ts("path",{class:"frame",fill:"none",d:`M${Aa} ${eh}V${xo-_f}H${Qc-gf}`}));for(let[S,C]of[[a,0],[l,8]])d.append(ts("text",{x:Aa-5,y:v(S)+C,"text-anchor":"end"},c.text(S)));d.append(ts("text",{x:Aa,y:xo-5},tn(u/p.factor,3))),d.append(ts("text",{x:Qc-gf,y:xo-5,"text-anchor":"end"},`${tn(h/p.factor,3)} ${p.unit}`));let y="",T=!1;s.forEach((S,C)=>{if(!Number.isFinite(S)){T=!1;return}y+=`${T?"L":"M"}${g(n[C]).toFixed(1)} ${v(S).toFixed(1)}`,T=!0}),d.append(ts("path",{class:"curve",fill:"none",d:y})),n[r]>=u&&n[r]<=h&&d.append(ts("path",{class:"now",d:`M${g(n[r]).toFixed(1)} ${eh}V${xo-_f}`})),Number.isFinite(s[r])&&d.append(ts("circle",{class:"dot",r:3.5,cx:g(n[r]),cy:v(s[r])})),i.append(d)}var GM=84,Hm=56,xf=14,HM=34,vf=11,th=i=>Math.max(i.scaleBar+16,Hm*(1+Object.keys(i.directions).length)),yf=GM;function Ta(i){let e=10**Math.floor(Math.log10(i)+1e-12);return Number((e*[5,2,1].find(t=>t*e<=i*(1+1e-12))).toPrecision(12))}function Sf(i,e,t,n,s,r,o,a){let l=b=>["right","up","towards"].map(U=>n[U].x*b[0]+n[U].y*b[1]+n[U].z*b[2]),c=Object.entries(r.directions),f=e+th(r)*a,u=(b,U,D)=>{i.strokeStyle=U,i.lineWidth=D*a,i.beginPath(),b.forEach(([P,z],V)=>V?i.lineTo(P,z):i.moveTo(P,z)),i.stroke()},h=(b,U,D,P)=>{i.fillStyle=P,i.beginPath(),i.arc(b,U,D*a,0,7),i.fill()},p=(b,U,D,P="center")=>{i.font=`${12*a}px ${o.font}`,i.fillStyle=o.ink,i.textAlign=P,i.textBaseline="middle",i.fillText(b,U,D)},g=b=>f-(c.length-b+.5)*Hm*a,v=g(0),d=t+30*a,m=[],y=["x","y","z"].map((b,U)=>[b,l([0,1,2].map(D=>D===U?1:0))]);for(let[b,[U,D]]of y.sort((P,z)=>P[1][2]-z[1][2])){u([[v,d],[v+xf*a*U,d-xf*a*D]],o.soft,1.5);let P=Math.hypot(U,D),z=P<.3?[-.7,-.7]:[U/P,D/P],V=P<.3?vf:xf*P+8,L=[v+V*a*z[0],d-V*a*z[1]];m.some(H=>Math.hypot(L[0]-H[0],L[1]-H[1])<vf*a)&&(L[1]+=vf*a),m.push(L),p(b,...L)}h(v,d,2,o.soft),c.forEach(([b,U],D)=>{let P=g(D+1),z=t+20*a,[V,L,H]=l(U),Z=Math.hypot(V,L),k=b==="flow"?o.accent:o.soft;if(p(b,P,t+48*a),Z<.35){if(i.strokeStyle=k,i.lineWidth=2*a,i.beginPath(),i.arc(P,z,8*a,0,7),i.stroke(),H>0)h(P,z,2.5,k);else for(let ne of[-1,1])u([[P-5*a,z-5*ne*a],[P+5*a,z+5*ne*a]],k,2);return}let he=[V/Z,-L/Z],Y=.5*HM*a*Z,Q=(ne,de)=>[P+ne*he[0]-de*he[1],z+ne*he[1]+de*he[0]];u([Q(-Y,0),Q(Y-6*a,0)],k,2),i.fillStyle=k,i.beginPath();for(let[ne,de]of[[Y,0],[Y-9*a,4.5*a],[Y-9*a,-4.5*a]])i.lineTo(...Q(ne,de));i.fill()});let T=Ta(r.scaleBar*s),S=hi(T,"m"),[C,E,_]=[f-6*a-T/s*a,f-6*a,t+66*a];return u([[C,_-4*a],[C,_],[E,_],[E,_-4*a]],o.ink,1.5),p(S,(C+E)/2,_+10*a),i.textBaseline="alphabetic",i.textAlign="left",S}async function WM(i){let e;if(Uint8Array.fromBase64)e=Uint8Array.fromBase64(i);else{let n=atob(i);e=new Uint8Array(n.length);for(let s=0;s<n.length;s++)e[s]=n.charCodeAt(s)}let t=new Blob([e]).stream().pipeThrough(new DecompressionStream("deflate"));return new Uint8Array(await new Response(t).arrayBuffer())}function XM(i){let e=document.getElementById(`section-${i}`),t=e.textContent.trim();return e.remove(),t}var Mf=64,Wm=14,bf=2**Wm,qM=2+24*bf;async function Zn(i,e=Int32Array){let t=await WM(XM(i.section)),n=i.shape[0],{order:s,bytes:r}=i,o=i.shape.reduce((g,v)=>g*v,1),a=n?o/n:0,l=new e(o),[c,f,u,h]=[0,1,2,3].map(g=>t.subarray(g*o,(g+1)*o)),p=new Int32Array(n*Mf);for(let g=0,v=0;g<a;g+=Mf){let d=Math.min(a,g+Mf),m=d-g;for(let y=0;y<m;y++){let T=0,S=0;for(let C=0;C<n;C++,v++){let E=c[v];r>1&&(E|=f[v]<<8),r>2&&(E|=u[v]<<16),r>3&&(E|=h[v]<<24);let _=E>>>1^-(E&1);s===0?T=_:s===1?T+=_:(S+=_,T+=S),p[C*m+y]=T}}for(let y=0;y<n;y++)l.set(p.subarray(y*m,(y+1)*m),y*a+g)}return l}async function Ea(i,e){let t=await Zn(i),n=new Float32Array(t.length);for(let s=0;s<t.length;s++){let r=s%3;n[s]=(i.low[r]+i.step[0]*t[s]-e.middle[r])/e.size}return n}var wf=class{constructor(e,t,n){Object.assign(this,e),this.whole=t,this.n=n,this.components=e.shape[2],this.constant=e.shape[0]===1,this.own=e.parts.filter(s=>s!=="magnitude")}at(e,t,n){let s=this.constant?0:e,r=this.whole[(s*this.n+t)*this.components+n];if(r===0)return NaN;let o=r-qM,a=Math.abs(o)-1;return o===0?0:Math.sign(o)*this.low[n]*2**(a>>Wm)*(1+a%bf/bf)}value(e,t,n){if(n!=="magnitude")return this.at(e,t,Math.max(0,this.own.indexOf(n)));let s=0;for(let r=0;r<this.components;r++)s+=this.at(e,t,r)**2;return Math.sqrt(s)}},Af=class{constructor(e,t,n){Object.assign(this,e),this.whole=t,this.n=n,this.constant=e.shape[0]===1}code(e,t){return this.whole[(this.constant?0:e)*this.n+t]}meaning(e,t){return this.meanings[this.code(e,t)]??""}};async function Xm(){let i=JSON.parse(document.getElementById("scene").textContent),e=i.bodies.ids.shape[0],t=i.times.length,n=i.frame,s={},r={};for(let[u,h]of Object.entries(i.codes))s[u]=new Af(h,await Zn(h,Uint8Array),e);for(let[u,h]of Object.entries(i.fields))r[u]=new wf(h,await Zn(h),e);let o=[];for(let u of i.surfaces){let h=u.density?await Zn(u.density,Uint8Array):null;o.push({...u,density:h,points:await Ea(u.points,n),triangles:await Zn(u.triangles,Uint32Array)})}let a=null;if(i.flow){let{lines:u}=i.flow,h=[];for(let p of i.flow.values)h.push({...p,whole:await Zn(p,Uint8Array)});a={...i.flow,values:h,lines:{...u,points:await Ea(u.points,n),start:await Zn(u.start)}}}let l=async u=>Float64Array.from(await Zn(u),h=>u.low[0]+u.step[0]*h),c=null;i.paths&&(c={bodies:await Zn(i.paths.bodies),start:await Zn(i.paths.start),points:await Ea(i.paths.points,n),times:await l(i.paths.times)});let f=Float32Array.from(await l(i.bodies.radius),u=>u/n.size);return{scene:i,n:e,m:t,times:i.times,codes:s,fields:r,surfaces:o,flow:a,paths:c,radius:f,edges:await Ea(i.edges,n),ids:await Zn(i.bodies.ids,Float64Array),x:await Ea(i.bodies.places,n),F:await Zn(i.bodies.shapes,Int16Array),shapeStep:i.bodies.shapes.step[0],B:i.bodies.modes?await Zn(i.bodies.modes,Int16Array):null,modeStep:i.bodies.modes?i.bodies.modes.step[0]:0,bits:await Zn(i.bodies.present,Uint8Array),bytesOfBits:i.bodies.present.shape[1],jumps(u,h){let p=3*(e*(u-1)+h),g=3*(e*u+h),{x:v}=this,d=Math.hypot(v[g]-v[p],v[g+1]-v[p+1],v[g+2]-v[p+2]);if(d<.1||!r.U)return!1;let m=Math.max(...[u-1,u].map(y=>r.U.value(y,h,"magnitude")));return d*n.size>10*m*(i.times[u]-i.times[u-1])},present(u,h){return this.bits[u*this.bytesOfBits+(h>>3)]>>(h&7)&1}}}var YM=`
precision highp float;
in vec3 position, normal;
in float density;
uniform mat4 modelViewMatrix, projectionMatrix;
out vec3 across, place;
out float amount;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  amount = density;
  across = mat3(modelViewMatrix) * normal;
  place = seen.xyz;
  gl_Position = projectionMatrix * seen;
}`,$M=`
precision highp float;
in vec3 across, place;
in float amount;
uniform vec3 base, deep;
uniform float opacity, painted;
uniform sampler2D colours;
out vec4 colour;
${Zc}${mr}
void main() {
  // Towards the viewer: gl_FrontFacing is true for the visible side of any material.
  vec3 normal = normalize(dot(across, place) < 0.0 ? across : -across);
  vec3 towards = normalize(-place);
  float facing = abs(dot(normal, towards));
  float lit = 0.5 + 0.5 * dot(normal, normalize(vec3(-0.35, 0.75, 0.55)));
  vec3 seen = mix(deep, base, smoothstep(0.1, 0.95, lit));
  if (painted > 0.5) seen = (0.75 + 0.25 * lit) * texture(colours, vec2(amount, 0.5)).rgb;
  seen = hazed(seen, -place.z, 0.35);
  // Glass is denser at grazing angles.
  colour = vec4(seen, opacity >= 1.0 ? 1.0 : opacity * (1.0 + 2.5 * pow(1.0 - facing, 3.0)));
}`,ZM=`
precision highp float;
in vec3 position;
uniform mat4 modelViewMatrix, projectionMatrix;
out float distance;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  distance = -seen.z;
  gl_Position = projectionMatrix * seen;
  // Edges lie in front of their walls.
  gl_Position.z -= 2e-5 * gl_Position.w;
}`,JM=`
precision highp float;
in float distance;
uniform vec3 base;
uniform float opacity;
out vec4 colour;
${mr}
void main() {
  colour = vec4(hazed(base, distance, 0.6), opacity);
}`,KM=`
precision highp float;
in vec3 position;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float ratio;
void main() {
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_Position.z = 0.0;
  gl_PointSize = 8.0 * ratio;
}`,jM=`
precision highp float;
uniform vec3 base, paper;
uniform float ratio;
out vec4 colour;
void main() {
  float away = 8.0 * ratio * length(gl_PointCoord - 0.5);
  float cover = 1.0 - smoothstep(4.0 * ratio - 1.0, 4.0 * ratio, away);
  if (cover <= 0.0) discard;
  colour = vec4(mix(base, paper, smoothstep(2.6 * ratio - 0.5, 2.6 * ratio + 0.5, away)), cover);
}`;function Tf(i,e,t,n={}){let s=Object.fromEntries(Object.entries(t).map(([r,o])=>[r,{value:o}]));return new oi({glslVersion:Mi,vertexShader:i,fragmentShader:e,uniforms:s,...n})}function Ef(i,e){let t=Tf(ZM,JM,{base:new W,opacity:i},{transparent:!0,depthWrite:!1});return t.uniforms.haze=e,t}var QM=i=>i.type==="wall"||i.type==="mappedWall",eb=i=>i.type==="empty"||i.type==="wedge",nh=class{constructor(e,t){this.group=new Li,this.patches=e.surfaces.map(s=>{let r=new xn;r.setAttribute("position",new Xt(s.points,3));let o=s.density??new Uint8Array(s.points.length/3);r.setAttribute("density",new Xt(o,1,!0)),r.setIndex(new Xt(s.triangles,1)),r.computeVertexNormals();let a=(c,f)=>{let u=new vn(r,Tf(YM,$M,{base:new W,deep:new W,opacity:1,darkness:0,painted:0,colours:null},c));return Object.assign(u.material.uniforms,{haze:t}),u.renderOrder=f,this.group.add(u),u},l={transparent:!0,depthWrite:!1};return{name:s.name,type:s.type,dense:!!s.density,visible:!eb(s),far:a({side:pn},0),veil:a({side:pn,...l},1),near:a({side:yi,...l},5)}});let n=new xn;n.setAttribute("position",new Xt(e.edges,3)),this.edges=new lr(n,Ef(.75,t)),this.edges.renderOrder=4,this.group.add(this.edges)}paint(e,t,n,s){for(let r of this.patches){let o=QM(r),a=s!==null&&r.dense;r.far.visible=r.visible&&t==="glass"&&o,r.veil.visible=r.visible&&t!=="none"&&!r.far.visible,r.near.visible=r.visible&&t!=="none";for(let l of[r.far,r.veil,r.near]){let{base:c,deep:f,opacity:u}=l.material.uniforms;c.value.set(...o?e.glass:e.accent),f.value.set(...o?e.glassDeep:e.accent),u.value=l===r.far?1:a?.35:o?t==="glass"?.1:.06:.05,l.material.uniforms.darkness.value=n?1:0,l.material.uniforms.painted.value=a?1:0,l.material.uniforms.colours.value=s}}this.edges.material.uniforms.base.value.set(...e.edge)}},ih=class{constructor(){this.points=new ia(new xn,Tf(KM,jM,{base:new W,paper:new W,ratio:1},{transparent:!0,depthTest:!1,depthWrite:!1})),this.points.frustumCulled=!1,this.points.renderOrder=6}draw(e){let t=new xn;t.setAttribute("position",new Xt(new Float32Array(e),3)),this.points.geometry.dispose(),this.points.geometry=t,this.points.visible=e.length>0}};var tb=`
precision highp float;
in vec3 position;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec4 half_space;
out float beyond;
void main() {
  beyond = dot(half_space.xyz, position) - half_space.w;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`,nb=`
precision highp float;
in float beyond;
out vec4 colour;
void main() { if (beyond < 0.0) discard; colour = vec4(0.0); }`,ib=`
precision highp float;
in vec3 position;
uniform mat4 modelViewMatrix, projectionMatrix;
out vec3 place;
void main() {
  place = position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  // Behind the edges of walls.
  gl_Position.z += 4e-5 * gl_Position.w;
}`,sb=`
precision highp float;
precision highp sampler3D;
in vec3 place;
uniform sampler3D grid;
uniform sampler2D colours;
uniform vec3 low, size, number;
out vec4 colour;
void main() {
  vec3 at = (0.5 + clamp((place - low) / size, 0.0, 1.0) * (number - 1.0)) / number;
  colour = vec4(texture(colours, vec2((texture(grid, at).r * 255.0 + 0.5) / 256.0, 0.5)).rgb, 1.0);
}`;function qm(i,e){let{points:t,start:n}=i.lines,s=[];for(let a=0;a+1<n.length;a++)for(let l=n[a]+1;l<n[a+1];l++)for(let c of[l-1,l])s.push(t[3*c],t[3*c+1],t[3*c+2]);let r=new xn;r.setAttribute("position",new Xt(new Float32Array(s),3));let o=new lr(r,Ef(i.lines.opacity,e));return o.renderOrder=2,o}var sh=class{constructor(e,t){let{low:n,high:s,values:r}=e.flow;this.low=new W(...n),this.high=new W(...s),this.group=new Li,this.half=new Lt;for(let{far:f}of t.patches)for(let[u,h]of[[yi,Yu],[pn,qu]]){let p=new vn(f.geometry,new oi({glslVersion:Mi,vertexShader:tb,fragmentShader:nb,uniforms:{half_space:{value:this.half}},side:u,colorWrite:!1,depthWrite:!1,depthTest:!1,stencilWrite:!0,stencilFunc:Vc,stencilZPass:h}));p.renderOrder=-2,this.group.add(p)}this.textures=r.map(({whole:f,shape:u})=>{let h=new io(f,u[2],u[1],u[0]);return Object.assign(h,{format:pa,minFilter:dn,magFilter:dn,unpackAlignment:1,needsUpdate:!0}),h});let[o,a,l]=r[0].shape,c=this.high.clone().sub(this.low).max(new W(1e-9,1e-9,1e-9));this.material=new oi({glslVersion:Mi,vertexShader:ib,fragmentShader:sb,side:Si,stencilWrite:!0,stencilFunc:$u,stencilRef:0,uniforms:{grid:{value:null},colours:{value:null},low:{value:this.low},size:{value:c},number:{value:new W(l,a,o)}}}),this.mesh=new vn(new xn,this.material),this.mesh.geometry.setAttribute("position",new Xt(new Float32Array(12),3)),this.mesh.geometry.setIndex([0,1,2,0,2,3]),this.mesh.frustumCulled=!1,this.mesh.renderOrder=-1,this.group.add(this.mesh),this.group.visible=!1}range(e){let t=this.low.clone().add(this.high).multiplyScalar(.5),n=this.high.clone().sub(t),s=Math.abs(e.x)*n.x+Math.abs(e.y)*n.y+Math.abs(e.z)*n.z;return[t.dot(e)-s,t.dot(e)+s]}place(e,t){Object.assign(this,{normal:e,offset:t});let n=this.low.clone().add(this.high).multiplyScalar(.5),s=this.high.distanceTo(this.low);this.centre=n.addScaledVector(e,t-n.dot(e));let r=new W(...Math.abs(e.x)<.7?[1,0,0]:[0,1,0]).cross(e).normalize(),o=e.clone().cross(r);[[-1,-1],[1,-1],[1,1],[-1,1]].forEach(([a,l],c)=>{this.centre.clone().addScaledVector(r,a*s).addScaledVector(o,l*s).toArray(this.mesh.geometry.attributes.position.array,3*c)}),this.mesh.geometry.attributes.position.needsUpdate=!0}show(e,t){this.group.visible=e in this.textures,this.group.visible&&(this.material.uniforms.grid.value=this.textures[e],this.material.uniforms.colours.value=t)}face(e){if(!this.normal)return;let t=e.dot(this.normal)>this.offset?-1:1;this.half.set(t*this.normal.x,t*this.normal.y,t*this.normal.z,t*this.offset)}};var gr=4,Cf=2,rh=15,Ym=22,$m=8,_r=gr*Cf,oh=class{constructor(e){this.data=e;let t={n:_r,x:new Float32Array(3*_r),F:new Int16Array(9*_r),radius:new Float32Array(_r),shapeStep:e.shapeStep,B:e.B&&new Int16Array(7*_r),modeStep:e.modeStep};this.own=t,this.bodies=new go(t,{value:new Lt(0,0,0,1e9)}),this.bodies.material.uniforms.smallest.value=0,this.scene=new sr,this.scene.add(this.bodies.mesh),this.camera=new Ln($m,1,1,100)}paint(e,t,n,s,r,o,a,l,c){let{data:f,own:u}=this,h=t.getPixelRatio(),p=e.clientWidth,g=Math.floor(p/gr),v=Cf*(g+rh),d=0;s.forEach((D,P)=>{u.F.set(f.F.subarray(9*(f.n*D+n),9*(f.n*D+n)+9),9*P);let z=u.F.subarray(9*P,9*P+9),V=0;if(f.B){let L=7*(f.n*D+n),H=f.B.subarray(L,L+7);u.B.set(H,7*P),V=Um(H)*f.modeStep}for(let L=0;L<3;L++)d=Math.max(d,Math.hypot(z[L],z[L+3],z[L+6])*f.shapeStep+V)});let m=1.25*d,y=(g+rh)/g;s.forEach((D,P)=>{let z=P%gr-(gr-1)/2,V=(Cf-1)/2-Math.floor(P/gr),L=a.right.clone().multiplyScalar(z).addScaledVector(a.up,V*y+.5*(rh/g));u.x.set([L.x,L.y,L.z],3*P),u.radius[P]=.5/m});for(let D of["colours","darkness","mark"])this.bodies.material.uniforms[D].value=l.uniforms[D].value;this.bodies.mesh.geometry.attributes.radius.needsUpdate=!0,this.bodies.show(0,D=>D<s.length,D=>o(s[D],n));let T=this.camera,S=.5*v/g/Math.tan($m*Math.PI/360);T.aspect=p/v,T.near=S-3,T.far=S+3,T.position.copy(a.towards).multiplyScalar(S),T.quaternion.setFromRotationMatrix(new It().makeBasis(a.right,a.up,a.towards)),T.updateProjectionMatrix(),T.updateMatrixWorld(!0);let C=t.getClearColor(new ht),[E,_]=[p*h,(v+Ym)*h].map(Math.round);t.setClearColor(c.raised,1),t.setViewport(0,0,p,v),t.setScissor(0,0,p,v),t.setScissorTest(!0),t.render(this.scene,T),(e.width!==E||e.height!==_)&&Object.assign(e,{width:E,height:_}),e.style.height=`${v+Ym}px`;let b=e.getContext("2d"),U=t.domElement;return b.clearRect(0,0,E,_),b.drawImage(U,0,U.height-Math.round(v*h),E,Math.round(v*h),0,0,E,Math.round(v*h)),t.setScissorTest(!1),t.setViewport(0,0,U.width/h,U.height/h),t.setClearColor(C,1),this.write(b,n,s,r,g,m,c,h,p,v)}write(e,t,n,s,r,o,a,l,c,f){let{times:u,radius:h,scene:p}=this.data,g=u[n[n.length-1]];e.textAlign="center";let v=n.reduce((E,_)=>Math.abs(u[_]-u[s])<Math.abs(u[E]-u[s])?_:E);n.forEach((E,_)=>{let b=(_%gr+.5)*r*l,U=(Math.floor(_/gr)*(r+rh)+r+10)*l;e.font=`${E===v?"600 ":""}${11*l}px ${a.font}`,e.fillStyle=E===v?a.ink:a.soft,e.fillText(hi(u[E],"s",g),b,U)});let d=2*o*h[t]*p.frame.size/r,m=Ta(1.6*r*d),y=hi(m,"m"),T=(f+9)*l,S=(c-4)*l,C=S-m/d*l;e.strokeStyle=a.ink,e.lineWidth=1.5*l,e.beginPath();for(let[E,[_,b]]of[[C,-4],[C,0],[S,0],[S,-4]].entries())e[E?"lineTo":"moveTo"](_,T+b*l);return e.stroke(),e.textAlign="right",e.font=`${11*l}px ${a.font}`,e.fillStyle=a.ink,e.fillText(y,C-6*l,T+1*l),`Shape at ${n.length} times from ${hi(u[n[0]],"s",g)} to ${hi(g,"s",g)}, to scale; bar of ${y}`}};var Zm=i=>{if(i.names)return{text:i.label,unit:"",note:"",factor:1};let{unit:e,factor:t}=es(i.unit,Math.max(Math.abs(i.low),Math.abs(i.high))),[n,s]=Jm(i),r=l=>tn(l/t,2),o=[n?`min ${r(i.least)}`:"",s?`max ${r(i.most)}`:""].filter(Boolean).join(", "),a=_o(e??"");return{text:i.label,unit:a,note:[a?`(${a})`:"",o].filter(Boolean).join(" "),factor:t}};function Jm(i){let e=1e-5*(i.high-i.low);return[i.least<i.low-e,i.most>i.high+e]}function Km(i,e,t){let[n,s]=Jm(i),r=e===i.low&&n,o=e===i.high&&s;return`${r?"≤ ":o?"≥ ":""}${tn(e/t,3)}`}function jm(i,e){let t=document.createElement("div");t.className="legend";let n=document.createElement("h2"),{text:s,unit:r,note:o,factor:a}=Zm(e);if(n.textContent=s,o){let l=document.createElement("small");l.textContent=o,n.append(l)}if(t.append(n),e.names){let l=document.createElement("ul");for(let[c,f]of e.names){let u=document.createElement("li"),h=document.createElement("span");h.className="swatch",h.style.background=Ws(c),u.append(h,f),l.append(u)}t.append(l)}else{let l=document.createElement("canvas");l.width=256,l.height=1,l.setAttribute("role","img"),l.setAttribute("aria-label",`Colours from ${tn(e.low/a)} to ${tn(e.high/a)} ${r}`),l.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(e.table),256,1),0,0);let c=document.createElement("div");c.className="ticks";for(let f of mf(e.low,e.high)){let u=document.createElement("span");u.textContent=Km(e,f,a),u.style.left=`${100*(f-e.low)/(e.high-e.low||1)}%`,c.append(u)}t.append(l,c)}i.append(t)}function Qm(i,e,t,n,s){let r=s-22*n;for(let o of[...e].reverse()){let{text:a,note:l,factor:c}=Zm(o),f=22*n;if(o.names){i.font=`${13*n}px ${t.font}`;let h=f;for(let[p,g]of o.names)i.fillStyle=Ws(p),i.beginPath(),i.arc(h+6*n,r-5*n,6*n,0,7),i.fill(),i.fillStyle=t.ink,i.fillText(g,h+18*n,r),h+=i.measureText(g).width+34*n;r-=22*n}else{i.font=`${12*n}px ${t.font}`,i.fillStyle=t.ink;for(let p of mf(o.low,o.high)){let g=(p-o.low)/(o.high-o.low||1);i.textAlign=g===0?"left":g===1?"right":"center",i.fillText(Km(o,p,c),f+280*n*g,r)}i.textAlign="left";let h=new OffscreenCanvas(256,1);h.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(o.table),256,1),0,0),i.drawImage(h,f,r-29*n,280*n,12*n),r-=37*n}i.font=`600 ${13*n}px ${t.font}`,i.fillStyle=t.ink,i.fillText(a,f,r);let u=i.measureText(`${a}  `).width;i.font=`${13*n}px ${t.font}`,i.fillStyle=t.soft,l&&i.fillText(l,f+u,r),r-=28*n}}var ah=class{constructor(e,t,n){Object.assign(this,{words:e,view:t,restore:n,timer:null}),this.fixed=[...e].filter(([s])=>["bare","naked","theme"].includes(s)),this.initial=this.text(),addEventListener("hashchange",()=>n(new URLSearchParams(location.hash.slice(1))))}text(){let e=t=>Array.isArray(t)?t.map(n=>Number(n.toPrecision(5))).join(","):t;return Object.entries(this.view()).map(([t,n])=>`${t}=${e(n)}`).join("&")}changed(){clearTimeout(this.timer),this.timer=setTimeout(()=>{let e=this.text();if(e===this.initial&&!this.written)return;this.written=!0;let t=[...this.fixed.map(([n,s])=>s?`${n}=${s}`:n),e].join("&");try{history.replaceState(null,"",`#${t}`)}catch{}},400)}};var rb="uplot",ob="u-hz",ab="u-vt",lb="u-title",cb="u-wrap",hb="u-under",ub="u-over",fb="u-axis",yr="u-off",db="u-select",pb="u-cursor-x",mb="u-cursor-y",gb="u-cursor-pt",_b="u-legend",xb="u-live",vb="u-inline",yb="u-series",Sb="u-marker",eg="u-label",Mb="u-value",Ra="width",Pa="height";var tg="bottom",vo="left",Rf="right",qf="#000",ng=qf+"0",Pf="mousemove",ig="mousedown",If="mouseup",sg="mouseenter",rg="mouseleave",og="dblclick",bb="resize",wb="scroll",ag="change",fh="dppxchange",Yf="--",To=typeof window<"u",Ff=To?document:null,So=To?window:null,Ab=To?navigator:null,At,lh;function Of(){let i=devicePixelRatio;At!=i&&(At=i,lh&&zf(ag,lh,Of),lh=matchMedia(`(min-resolution: ${At-.001}dppx) and (max-resolution: ${At+.001}dppx)`),Sr(ag,lh,Of),So.dispatchEvent(new CustomEvent(fh)))}function ui(i,e){if(e!=null){let t=i.classList;!t.contains(e)&&t.add(e)}}function Bf(i,e){let t=i.classList;t.contains(e)&&t.remove(e)}function qt(i,e,t){i.style[e]=t+"px"}function Fi(i,e,t,n){let s=Ff.createElement(i);return e!=null&&ui(s,e),t?.insertBefore(s,n),s}function bi(i,e){return Fi("div",i,e)}var lg=new WeakMap;function ns(i,e,t,n,s){let r="translate("+e+"px,"+t+"px)",o=lg.get(i);r!=o&&(i.style.transform=r,lg.set(i,r),e<0||t<0||e>n||t>s?ui(i,yr):Bf(i,yr))}var cg=new WeakMap;function hg(i,e,t){let n=e+t,s=cg.get(i);n!=s&&(cg.set(i,n),i.style.background=e,i.style.borderColor=t)}var ug=new WeakMap;function fg(i,e,t,n){let s=e+""+t,r=ug.get(i);s!=r&&(ug.set(i,s),i.style.height=t+"px",i.style.width=e+"px",i.style.marginLeft=n?-e/2+"px":0,i.style.marginTop=n?-t/2+"px":0)}var $f={passive:!0},Tb={...$f,capture:!0};function Sr(i,e,t,n){e.addEventListener(i,t,n?Tb:$f)}function zf(i,e,t,n){e.removeEventListener(i,t,$f)}To&&Of();function Oi(i,e,t,n){let s;t=t||0,n=n||e.length-1;let r=n<=2147483647;for(;n-t>1;)s=r?t+n>>1:fi((t+n)/2),e[s]<i?t=s:n=s;return i-e[t]<=e[n]-i?t:n}function kg(i){return(t,n,s)=>{let r=-1,o=-1;for(let a=n;a<=s;a++)if(i(t[a])){r=a;break}for(let a=s;a>=n;a--)if(i(t[a])){o=a;break}return[r,o]}}var Vg=i=>i!=null,Gg=i=>i!=null&&i>0,mh=kg(Vg),Eb=kg(Gg);function Cb(i,e,t,n=0,s=!1){let r=s?Eb:mh,o=s?Gg:Vg;[e,t]=r(i,e,t);let a=i[e],l=i[e];if(e>-1)if(n==1)a=i[e],l=i[t];else if(n==-1)a=i[t],l=i[e];else for(let c=e;c<=t;c++){let f=i[c];o(f)&&(f<a?a=f:f>l&&(l=f))}return[a??Ft,l??-Ft]}function gh(i,e,t,n){let s=mg(i),r=mg(e);i==e&&(s==-1?(i*=t,e/=t):(i/=t,e*=t));let o=t==10?Ms:Hg,a=s==1?fi:wi,l=r==1?wi:fi,c=a(o(bn(i))),f=l(o(bn(e))),u=Mo(t,c),h=Mo(t,f);return t==10&&(c<0&&(u=Ot(u,-c)),f<0&&(h=Ot(h,-f))),n||t==2?(i=u*s,e=h*r):(i=Yg(i,u),e=_h(e,h)),[i,e]}function Zf(i,e,t,n){let s=gh(i,e,t,n);return i==0&&(s[0]=0),e==0&&(s[1]=0),s}var Jf=.1,dg={mode:3,pad:Jf},La={pad:0,soft:null,mode:0},Rb={min:La,max:La};function dh(i,e,t,n){return xh(t)?pg(i,e,t):(La.pad=t,La.soft=n?0:null,La.mode=n?3:0,pg(i,e,Rb))}function bt(i,e){return i??e}function Pb(i,e,t){for(e=bt(e,0),t=bt(t,i.length-1);e<=t;){if(i[e]!=null)return!0;e++}return!1}function pg(i,e,t){let n=t.min,s=t.max,r=bt(n.pad,0),o=bt(s.pad,0),a=bt(n.hard,-Ft),l=bt(s.hard,Ft),c=bt(n.soft,Ft),f=bt(s.soft,-Ft),u=bt(n.mode,0),h=bt(s.mode,0),p=e-i,g=Ms(p),v=Xn(bn(i),bn(e)),d=Ms(v),m=bn(d-g);(p<1e-24||m>10)&&(p=0,(i==0||e==0)&&(p=1e-24,u==2&&c!=Ft&&(r=0),h==2&&f!=-Ft&&(o=0)));let y=p||v||1e3,T=Ms(y),S=Mo(10,fi(T)),C=y*(p==0?i==0?.1:1:r),E=Ot(Yg(i-C,S/10),24),_=i>=c&&(u==1||u==3&&E<=c||u==2&&E>=c)?c:Ft,b=Xn(a,E<_&&i>=_?_:Bi(_,E)),U=y*(p==0?e==0?.1:1:o),D=Ot(_h(e+U,S/10),24),P=e<=f&&(h==1||h==3&&D>=f||h==2&&D<=f)?f:-Ft,z=Bi(l,D>P&&e<=P?P:Xn(P,D));return b==z&&b==0&&(z=100),[b,z]}var Ib=new Intl.NumberFormat(To?Ab.language:"en-US"),Kf=i=>Ib.format(i),di=Math,uh=di.PI,bn=di.abs,fi=di.floor,Mn=di.round,wi=di.ceil,Bi=di.min,Xn=di.max,Mo=di.pow,mg=di.sign,Ms=di.log10,Hg=di.log2,Lb=(i,e=1)=>di.sinh(i)*e,Lf=(i,e=1)=>di.asinh(i/e),Ft=1/0;function gg(i){return(Ms((i^i>>31)-(i>>31))|0)+1}function kf(i,e,t){return Bi(Xn(i,e),t)}function Wg(i){return typeof i=="function"}function vt(i){return Wg(i)?i:()=>i}var Db=()=>{},Xg=i=>i,qg=(i,e)=>e,Nb=i=>null,_g=i=>!0,xg=(i,e)=>i==e,Ub=/\.\d*?(?=9{6,}|0{6,})/gm,Mr=i=>{if(Zg(i)||qs.has(i))return i;let e=`${i}`,t=e.match(Ub);if(t==null)return i;let n=t[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${Mr(s)}e${r}`}return Ot(i,n)};function xr(i,e){return Mr(Ot(Mr(i/e))*e)}function _h(i,e){return Mr(wi(Mr(i/e))*e)}function Yg(i,e){return Mr(fi(Mr(i/e))*e)}function Ot(i,e=0){if(Zg(i))return i;let t=10**e,n=i*t*(1+Number.EPSILON);return Mn(n)/t}var qs=new Map;function $g(i){return((""+i).split(".")[1]||"").length}function Na(i,e,t,n){let s=[],r=n.map($g);for(let o=e;o<t;o++){let a=bn(o),l=Ot(Mo(i,o),a);for(let c=0;c<n.length;c++){let f=i==10?+`${n[c]}e${o}`:n[c]*l,u=(o>=0?0:a)+(o>=r[c]?0:r[c]),h=i==10?f:Ot(f,u);s.push(h),qs.set(h,u)}}return s}var Da={},jf=[],bo=[null,null],Xs=Array.isArray,Zg=Number.isInteger,Fb=i=>i===void 0;function vg(i){return typeof i=="string"}function xh(i){let e=!1;if(i!=null){let t=i.constructor;e=t==null||t==Object}return e}function Ob(i){return i!=null&&typeof i=="object"}var Bb=Object.getPrototypeOf(Uint8Array),Jg="__proto__";function wo(i,e=xh){let t;if(Xs(i)){let n=i.find(s=>s!=null);if(Xs(n)||e(n)){t=Array(i.length);for(let s=0;s<i.length;s++)t[s]=wo(i[s],e)}else t=i.slice()}else if(i instanceof Bb)t=i.slice();else if(e(i)){t={};for(let n in i)n!=Jg&&(t[n]=wo(i[n],e))}else t=i;return t}function mn(i){let e=arguments;for(let t=1;t<e.length;t++){let n=e[t];for(let s in n)s!=Jg&&(xh(i[s])?mn(i[s],wo(n[s])):i[s]=wo(n[s]))}return i}var zb=0,kb=1,Vb=2;function Gb(i,e,t){for(let n=0,s,r=-1;n<e.length;n++){let o=e[n];if(o>r){for(s=o-1;s>=0&&i[s]==null;)i[s--]=null;for(s=o+1;s<t&&i[s]==null;)i[r=s++]=null}}}function Hb(i,e){if(qb(i)){let o=i[0].slice();for(let a=1;a<i.length;a++)o.push(...i[a].slice(1));return Yb(o[0])||(o=Xb(o)),o}let t=new Set;for(let o=0;o<i.length;o++){let l=i[o][0],c=l.length;for(let f=0;f<c;f++)t.add(l[f])}let n=[Array.from(t).sort((o,a)=>o-a)],s=n[0].length,r=new Map;for(let o=0;o<s;o++)r.set(n[0][o],o);for(let o=0;o<i.length;o++){let a=i[o],l=a[0];for(let c=1;c<a.length;c++){let f=a[c],u=Array(s).fill(void 0),h=e?e[o][c]:kb,p=[];for(let g=0;g<f.length;g++){let v=f[g],d=r.get(l[g]);v===null?h!=zb&&(u[d]=v,h==Vb&&p.push(d)):u[d]=v}Gb(u,p,s),n.push(u)}}return n}var Wb=typeof queueMicrotask>"u"?i=>Promise.resolve().then(i):queueMicrotask;function Xb(i){let e=i[0],t=e.length,n=Array(t);for(let r=0;r<n.length;r++)n[r]=r;n.sort((r,o)=>e[r]-e[o]);let s=[];for(let r=0;r<i.length;r++){let o=i[r],a=Array(t);for(let l=0;l<t;l++)a[l]=o[n[l]];s.push(a)}return s}function qb(i){let e=i[0][0],t=e.length;for(let n=1;n<i.length;n++){let s=i[n][0];if(s.length!=t)return!1;if(s!=e){for(let r=0;r<t;r++)if(s[r]!=e[r])return!1}}return!0}function Yb(i,e=100){let t=i.length;if(t<=1)return!0;let n=0,s=t-1;for(;n<=s&&i[n]==null;)n++;for(;s>=n&&i[s]==null;)s--;if(s<=n)return!0;let r=Xn(1,fi((s-n+1)/e));for(let o=i[n],a=n+r;a<=s;a+=r){let l=i[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var Kg=["January","February","March","April","May","June","July","August","September","October","November","December"],jg=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Qg(i){return i.slice(0,3)}var $b=jg.map(Qg),Zb=Kg.map(Qg),Jb={MMMM:Kg,MMM:Zb,WWWW:jg,WWW:$b};function Ca(i){return(i<10?"0":"")+i}function Kb(i){return(i<10?"00":i<100?"0":"")+i}var jb={YYYY:i=>i.getFullYear(),YY:i=>(i.getFullYear()+"").slice(2),MMMM:(i,e)=>e.MMMM[i.getMonth()],MMM:(i,e)=>e.MMM[i.getMonth()],MM:i=>Ca(i.getMonth()+1),M:i=>i.getMonth()+1,DD:i=>Ca(i.getDate()),D:i=>i.getDate(),WWWW:(i,e)=>e.WWWW[i.getDay()],WWW:(i,e)=>e.WWW[i.getDay()],HH:i=>Ca(i.getHours()),H:i=>i.getHours(),h:i=>{let e=i.getHours();return e==0?12:e>12?e-12:e},AA:i=>i.getHours()>=12?"PM":"AM",aa:i=>i.getHours()>=12?"pm":"am",a:i=>i.getHours()>=12?"p":"a",mm:i=>Ca(i.getMinutes()),m:i=>i.getMinutes(),ss:i=>Ca(i.getSeconds()),s:i=>i.getSeconds(),fff:i=>Kb(i.getMilliseconds())};function Qf(i,e){e=e||Jb;let t=[],n=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=n.exec(i);)t.push(s[0][0]=="{"?jb[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<t.length;a++)o+=typeof t[a]=="string"?t[a]:t[a](r,e);return o}}var Qb=new Intl.DateTimeFormat().resolvedOptions().timeZone;function ew(i,e){let t;return e=="UTC"||e=="Etc/UTC"?t=new Date(+i+i.getTimezoneOffset()*6e4):e==Qb?t=i:(t=new Date(i.toLocaleString("en-US",{timeZone:e})),t.setMilliseconds(i.getMilliseconds())),t}var e0=i=>i%1==0,ph=[1,2,2.5,5],tw=Na(10,-32,0,ph),t0=Na(10,0,32,ph),nw=t0.filter(e0),vr=tw.concat(t0),ed=`
`,n0="{YYYY}",yg=ed+n0,i0="{M}/{D}",Ia=ed+i0,ch=Ia+"/{YY}",s0="{aa}",iw="{h}:{mm}",yo=iw+s0,Sg=ed+yo,Mg=":{ss}",Et=null;function r0(i){let e=i*1e3,t=e*60,n=t*60,s=n*24,r=s*30,o=s*365,l=(i==1?Na(10,0,3,ph).filter(e0):Na(10,-3,0,ph)).concat([e,e*5,e*10,e*15,e*30,t,t*5,t*10,t*15,t*30,n,n*2,n*3,n*4,n*6,n*8,n*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),c=[[o,n0,Et,Et,Et,Et,Et,Et,1],[s*28,"{MMM}",yg,Et,Et,Et,Et,Et,1],[s,i0,yg,Et,Et,Et,Et,Et,1],[n,"{h}"+s0,ch,Et,Ia,Et,Et,Et,1],[t,yo,ch,Et,Ia,Et,Et,Et,1],[e,Mg,ch+" "+yo,Et,Ia+" "+yo,Et,Sg,Et,1],[i,Mg+".{fff}",ch+" "+yo,Et,Ia+" "+yo,Et,Sg,Et,1]];function f(u){return(h,p,g,v,d,m)=>{let y=[],T=d>=o,S=d>=r&&d<o,C=u(g),E=Ot(C*i,3),_=Df(C.getFullYear(),T?0:C.getMonth(),S||T?1:C.getDate()),b=Ot(_*i,3);if(S||T){let U=S?d/r:0,D=T?d/o:0,P=E==b?E:Ot(Df(_.getFullYear()+D,_.getMonth()+U,1)*i,3),z=new Date(Mn(P/i)),V=z.getFullYear(),L=z.getMonth();for(let H=0;P<=v;H++){let Z=Df(V+D*H,L+U*H,1),k=Z-u(Ot(Z*i,3));P=Ot((+Z+k)*i,3),P<=v&&y.push(P)}}else{let U=d>=s?s:d,D=fi(g)-fi(E),P=b+D+_h(E-b,U);y.push(P);let z=u(P),V=z.getHours()+z.getMinutes()/t+z.getSeconds()/n,L=d/n,H=h.axes[p]._space,Z=m/H;for(;P=Ot(P+d,i==1?0:3),!(P>v);)if(L>1){let k=fi(Ot(V+L,6))%24,Q=u(P).getHours()-k;Q>1&&(Q=-1),P-=Q*n,V=(V+L)%24;let ne=y[y.length-1];Ot((P-ne)/d,3)*Z>=.7&&y.push(P)}else y.push(P)}return y}}return[l,c,f]}var[sw,rw,ow]=r0(1),[aw,lw,cw]=r0(.001);Na(2,-53,53,[1]);function bg(i,e){return i.map(t=>t.map((n,s)=>s==0||s==8||n==null?n:e(s==1||t[8]==0?n:t[1]+n)))}function wg(i,e){return(t,n,s,r,o)=>{let a=e.find(g=>o>=g[0])||e[e.length-1],l,c,f,u,h,p;return n.map(g=>{let v=i(g),d=v.getFullYear(),m=v.getMonth(),y=v.getDate(),T=v.getHours(),S=v.getMinutes(),C=v.getSeconds(),E=d!=l&&a[2]||m!=c&&a[3]||y!=f&&a[4]||T!=u&&a[5]||S!=h&&a[6]||C!=p&&a[7]||a[1];return l=d,c=m,f=y,u=T,h=S,p=C,E(v)})}}function hw(i,e){let t=Qf(e);return(n,s,r,o,a)=>s.map(l=>t(i(l)))}function Df(i,e,t){return new Date(i,e,t)}function Ag(i,e){return e(i)}var uw="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function Tg(i,e){return(t,n,s,r)=>r==null?Yf:e(i(n))}function fw(i,e){let t=i.series[e];return t.width?t.stroke(i,e):t.points.width?t.points.stroke(i,e):null}function dw(i,e){return i.series[e].fill(i,e)}var pw={show:!0,live:!0,isolate:!1,mount:Db,markers:{show:!0,width:2,stroke:fw,fill:dw,dash:"solid"},idx:null,idxs:null,values:[]};function mw(i,e){let t=i.cursor.points,n=bi(),s=t.size(i,e);qt(n,Ra,s),qt(n,Pa,s);let r=s/-2;qt(n,"marginLeft",r),qt(n,"marginTop",r);let o=t.width(i,e,s);return o&&qt(n,"borderWidth",o),n}function gw(i,e){let t=i.series[e].points;return t._fill||t._stroke}function _w(i,e){let t=i.series[e].points;return t._stroke||t._fill}function xw(i,e){return i.series[e].points.size}var Nf=[0,0];function vw(i,e,t){return Nf[0]=e,Nf[1]=t,Nf}function hh(i,e,t,n=!0){return s=>{s.button==0&&(!n||s.target==e)&&t(s)}}function Uf(i,e,t,n=!0){return s=>{(!n||s.target==e)&&t(s)}}var yw={show:!0,x:!0,y:!0,lock:!1,move:vw,points:{one:!1,show:mw,size:xw,width:0,stroke:_w,fill:gw},bind:{mousedown:hh,mouseup:hh,click:hh,dblclick:hh,mousemove:Uf,mouseleave:Uf,mouseenter:Uf},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(i,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(i,e,t,n,s)=>n-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},o0={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},td=mn({},o0,{filter:qg}),a0=mn({},td,{size:10}),l0=mn({},o0,{show:!1}),nd='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',c0="bold "+nd,h0=1.5,Eg={show:!0,scale:"x",stroke:qf,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:c0,side:2,grid:td,ticks:a0,border:l0,font:nd,lineGap:h0,rotate:0},Sw="Value",Mw="Time",Cg={show:!0,scale:"x",auto:!1,sorted:1,min:Ft,max:-Ft,idxs:[]};function bw(i,e,t,n,s){return e.map(r=>r==null?"":Kf(r))}function ww(i,e,t,n,s,r,o){let a=[],l=qs.get(s)||0;t=o?t:Ot(_h(t,s),l);for(let c=t;c<=n;c=Ot(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function Vf(i,e,t,n,s,r,o){let a=[],l=i.scales[i.axes[e].scale].log,c=l==10?Ms:Hg,f=fi(c(t));s=Mo(l,f),l==10&&(s=vr[Oi(s,vr)]);let u=t,h=s*l;l==10&&(h=vr[Oi(h,vr)]);do a.push(u),u=u+s,l==10&&!qs.has(u)&&(u=Ot(u,qs.get(s))),u>=h&&(s=u,h=s*l,l==10&&(h=vr[Oi(h,vr)]));while(u<=n);return a}function Aw(i,e,t,n,s,r,o){let l=i.scales[i.axes[e].scale].asinh,c=n>l?Vf(i,e,Xn(l,t),n,s):[l],f=n>=0&&t<=0?[0]:[];return(t<-l?Vf(i,e,Xn(l,-n),-t,s):[l]).reverse().map(h=>-h).concat(f,c)}var u0=/./,Tw=/[12357]/,Ew=/[125]/,Rg=/1/,Gf=(i,e,t,n)=>i.map((s,r)=>e==4&&s==0||r%n==0&&t.test(s.toExponential()[s<0?1:0])?s:null);function Cw(i,e,t,n,s){let r=i.axes[t],o=r.scale,a=i.scales[o],l=i.valToPos,c=r._space,f=l(10,o),u=l(9,o)-f>=c?u0:l(7,o)-f>=c?Tw:l(5,o)-f>=c?Ew:Rg;if(u==Rg){let h=bn(l(1,o)-f);if(h<c)return Gf(e.slice().reverse(),a.distr,u,wi(c/h)).reverse()}return Gf(e,a.distr,u,1)}function Rw(i,e,t,n,s){let r=i.axes[t],o=r.scale,a=r._space,l=i.valToPos,c=bn(l(1,o)-l(2,o));return c<a?Gf(e.slice().reverse(),3,u0,wi(a/c)).reverse():e}function Pw(i,e,t,n){return n==null?Yf:e==null?"":Kf(e)}var Pg={show:!0,scale:"y",stroke:qf,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:c0,side:3,grid:td,ticks:a0,border:l0,font:nd,lineGap:h0,rotate:0};function Iw(i,e){let t=3+(i||1)*2;return Ot(t*e,3)}function Lw(i,e){let{scale:t,idxs:n}=i.series[0],s=i._data[0],r=i.valToPos(s[n[0]],t,!0),o=i.valToPos(s[n[1]],t,!0),a=bn(o-r),l=i.series[e],c=a/(l.points.space*At);return n[1]-n[0]<=c}var Ig={scale:null,auto:!0,sorted:0,min:Ft,max:-Ft},f0=(i,e,t,n,s)=>s,Lg={show:!0,auto:!0,sorted:0,gaps:f0,alpha:1,facets:[mn({},Ig,{scale:"x"}),mn({},Ig,{scale:"y"})]},Dg={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:f0,alpha:1,points:{show:Lw,filter:null},values:null,min:Ft,max:-Ft,idxs:[],path:null,clip:null};function Dw(i,e,t,n,s){return t/10}var d0={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},Nw=mn({},d0,{time:!1,ori:1}),Ng={};function p0(i,e){let t=Ng[i];return t||(t={key:i,plots:[],sub(n){t.plots.push(n)},unsub(n){t.plots=t.plots.filter(s=>s!=n)},pub(n,s,r,o,a,l,c){for(let f=0;f<t.plots.length;f++)t.plots[f]!=s&&t.plots[f].pub(n,s,r,o,a,l,c)}},i!=null&&(Ng[i]=t)),t}var Ao=1,Hf=2;function br(i,e,t){let n=i.mode,s=i.series[e],r=n==2?i._data[e]:i._data,o=i.scales,a=i.bbox,l=r[0],c=n==2?r[1]:r[e],f=n==2?o[s.facets[0].scale]:o[i.series[0].scale],u=n==2?o[s.facets[1].scale]:o[s.scale],h=a.left,p=a.top,g=a.width,v=a.height,d=i.valToPosH,m=i.valToPosV;return f.ori==0?t(s,l,c,f,u,d,m,h,p,g,v,yh,Eo,Mh,g0,x0):t(s,l,c,f,u,m,d,p,h,v,g,Sh,Co,rd,_0,v0)}function id(i,e){let t=0,n=0,s=bt(i.bands,jf);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==e?t=o.dir:o.series[1]==e&&(o.dir==1?n|=1:n|=2)}return[t,n==1?-1:n==2?1:n==3?2:0]}function Uw(i,e,t,n,s){let r=i.mode,o=i.series[e],a=r==2?o.facets[1].scale:o.scale,l=i.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function bs(i,e,t,n,s,r){return br(i,e,(o,a,l,c,f,u,h,p,g,v,d)=>{let m=o.pxRound,y=c.dir*(c.ori==0?1:-1),T=c.ori==0?Eo:Co,S,C;y==1?(S=t,C=n):(S=n,C=t);let E=m(u(a[S],c,v,p)),_=m(h(l[S],f,d,g)),b=m(u(a[C],c,v,p)),U=m(h(r==1?f.max:f.min,f,d,g)),D=new Path2D(s);return T(D,b,U),T(D,E,U),T(D,E,_),D})}function vh(i,e,t,n,s,r){let o=null;if(i.length>0){o=new Path2D;let a=e==0?Mh:rd,l=t;for(let u=0;u<i.length;u++){let h=i[u];if(h[1]>h[0]){let p=h[0]-l;p>0&&a(o,l,n,p,n+r),l=h[1]}}let c=t+s-l,f=10;c>0&&a(o,l,n-f/2,c,n+r+f)}return o}function Fw(i,e,t){let n=i[i.length-1];n&&n[0]==e?n[1]=t:i.push([e,t])}function sd(i,e,t,n,s,r,o){let a=[],l=i.length;for(let c=s==1?t:n;c>=t&&c<=n;c+=s)if(e[c]===null){let u=c,h=c;if(s==1)for(;++c<=n&&e[c]===null;)h=c;else for(;--c>=t&&e[c]===null;)h=c;let p=r(i[u]),g=h==u?p:r(i[h]),v=u-s;p=o<=0&&v>=0&&v<l?r(i[v]):p;let m=h+s;g=o>=0&&m>=0&&m<l?r(i[m]):g,g>=p&&a.push([p,g])}return a}function Ug(i){return i==0?Xg:i==1?Mn:e=>xr(e,i)}function m0(i){let e=i==0?yh:Sh,t=i==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},n=i==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,f=0)=>{c==0&&f==0?n(s,r,o,a,l):(c=Bi(c,a/2,l/2),f=Bi(f,a/2,l/2),e(s,r+c,o),t(s,r+a,o,r+a,o+l,c),t(s,r+a,o+l,r,o+l,f),t(s,r,o+l,r,o,f),t(s,r,o,r+a,o,c),s.closePath())}}var yh=(i,e,t)=>{i.moveTo(e,t)},Sh=(i,e,t)=>{i.moveTo(t,e)},Eo=(i,e,t)=>{i.lineTo(e,t)},Co=(i,e,t)=>{i.lineTo(t,e)},Mh=m0(0),rd=m0(1),g0=(i,e,t,n,s,r)=>{i.arc(e,t,n,s,r)},_0=(i,e,t,n,s,r)=>{i.arc(t,e,n,s,r)},x0=(i,e,t,n,s,r,o)=>{i.bezierCurveTo(e,t,n,s,r,o)},v0=(i,e,t,n,s,r,o)=>{i.bezierCurveTo(t,e,s,n,o,r)};function y0(i){return(e,t,n,s,r)=>br(e,t,(o,a,l,c,f,u,h,p,g,v,d)=>{let{pxRound:m,points:y}=o,T,S;c.ori==0?(T=yh,S=g0):(T=Sh,S=_0);let C=Ot(y.width*At,3),E=(y.size-y.width)/2*At,_=Ot(E*2,3),b=new Path2D,U=new Path2D,{left:D,top:P,width:z,height:V}=e.bbox;Mh(U,D-_,P-_,z+_*2,V+_*2);let L=H=>{if(l[H]!=null){let Z=m(u(a[H],c,v,p)),k=m(h(l[H],f,d,g));T(b,Z+E,k),S(b,Z,k,E,0,uh*2)}};if(r)r.forEach(L);else for(let H=n;H<=s;H++)L(H);return{stroke:C>0?b:null,fill:b,clip:U,flags:Ao|Hf}})}function S0(i){return(e,t,n,s,r,o)=>{n!=s&&(r!=n&&o!=n&&i(e,t,n),r!=s&&o!=s&&i(e,t,s),i(e,t,o))}}var Ow=S0(Eo),Bw=S0(Co);function M0(i){let e=bt(i?.alignGaps,0);return(t,n,s,r)=>br(t,n,(o,a,l,c,f,u,h,p,g,v,d)=>{[s,r]=mh(l,s,r);let m=o.pxRound,y=V=>m(u(V,c,v,p)),T=V=>m(h(V,f,d,g)),S,C;c.ori==0?(S=Eo,C=Ow):(S=Co,C=Bw);let E=c.dir*(c.ori==0?1:-1),_={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Ao},b=_.stroke,U=!1;if(r-s>=v*4){let V=pe=>t.posToVal(pe,c.key,!0),L=null,H=null,Z,k,he,Y=y(a[E==1?s:r]),Q=y(a[s]),ne=y(a[r]),de=V(E==1?Q+1:ne-1);for(let pe=E==1?s:r;pe>=s&&pe<=r;pe+=E){let ee=a[pe],ye=(E==1?ee<de:ee>de)?Y:y(ee),Re=l[pe];ye==Y?Re!=null?(k=Re,L==null?(S(b,ye,T(k)),Z=L=H=k):k<L?L=k:k>H&&(H=k)):Re===null&&(U=!0):(L!=null&&C(b,Y,T(L),T(H),T(Z),T(k)),Re!=null?(k=Re,S(b,ye,T(k)),L=H=Z=k):(L=H=null,Re===null&&(U=!0)),Y=ye,de=V(Y+E))}L!=null&&L!=H&&he!=Y&&C(b,Y,T(L),T(H),T(Z),T(k))}else for(let V=E==1?s:r;V>=s&&V<=r;V+=E){let L=l[V];L===null?U=!0:L!=null&&S(b,y(a[V]),T(L))}let[P,z]=id(t,n);if(o.fill!=null||P!=0){let V=_.fill=new Path2D(b),L=o.fillTo(t,n,o.min,o.max,P),H=T(L),Z=y(a[s]),k=y(a[r]);E==-1&&([k,Z]=[Z,k]),S(V,k,H),S(V,Z,H)}if(!o.spanGaps){let V=[];U&&V.push(...sd(a,l,s,r,E,y,e)),_.gaps=V=o.gaps(t,n,s,r,V),_.clip=vh(V,c.ori,p,g,v,d)}return z!=0&&(_.band=z==2?[bs(t,n,s,r,b,-1),bs(t,n,s,r,b,1)]:bs(t,n,s,r,b,z)),_})}function zw(i){let e=bt(i.align,1),t=bt(i.ascDesc,!1),n=bt(i.alignGaps,0),s=bt(i.extend,!1);return(r,o,a,l)=>br(r,o,(c,f,u,h,p,g,v,d,m,y,T)=>{[a,l]=mh(u,a,l);let S=c.pxRound,{left:C,width:E}=r.bbox,_=Q=>S(g(Q,h,y,d)),b=Q=>S(v(Q,p,T,m)),U=h.ori==0?Eo:Co,D={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Ao},P=D.stroke,z=h.dir*(h.ori==0?1:-1),V=b(u[z==1?a:l]),L=_(f[z==1?a:l]),H=L,Z=L;s&&e==-1&&(Z=C,U(P,Z,V)),U(P,L,V);for(let Q=z==1?a:l;Q>=a&&Q<=l;Q+=z){let ne=u[Q];if(ne==null)continue;let de=_(f[Q]),pe=b(ne);e==1?U(P,de,V):U(P,H,pe),U(P,de,pe),V=pe,H=de}let k=H;s&&e==1&&(k=C+E,U(P,k,V));let[he,Y]=id(r,o);if(c.fill!=null||he!=0){let Q=D.fill=new Path2D(P),ne=c.fillTo(r,o,c.min,c.max,he),de=b(ne);U(Q,k,de),U(Q,Z,de)}if(!c.spanGaps){let Q=[];Q.push(...sd(f,u,a,l,z,_,n));let ne=c.width*At/2,de=t||e==1?ne:-ne,pe=t||e==-1?-ne:ne;Q.forEach(ee=>{ee[0]+=de,ee[1]+=pe}),D.gaps=Q=c.gaps(r,o,a,l,Q),D.clip=vh(Q,h.ori,d,m,y,T)}return Y!=0&&(D.band=Y==2?[bs(r,o,a,l,P,-1),bs(r,o,a,l,P,1)]:bs(r,o,a,l,P,Y)),D})}function Fg(i,e,t,n,s,r,o=Ft){if(i.length>1){let a=null;for(let l=0,c=1/0;l<i.length;l++)if(e[l]!==void 0){if(a!=null){let f=bn(i[l]-i[a]);f<c&&(c=f,o=bn(t(i[l],n,s,r)-t(i[a],n,s,r)))}a=l}}return o}function kw(i){i=i||Da;let e=bt(i.size,[.6,Ft,1]),t=i.align||0,n=i.gap||0,s=i.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let r=vt(s),o=1-e[0],a=bt(e[1],Ft),l=bt(e[2],1),c=bt(i.disp,Da),f=bt(i.each,p=>{}),{fill:u,stroke:h}=c;return(p,g,v,d)=>br(p,g,(m,y,T,S,C,E,_,b,U,D,P)=>{let z=m.pxRound,V=t,L=n*At,H=a*At,Z=l*At,k,he;S.ori==0?[k,he]=r(p,g):[he,k]=r(p,g);let Y=S.dir*(S.ori==0?1:-1),Q=S.ori==0?Mh:rd,ne=S.ori==0?f:(Ie,Ze,ot,Ae,Ut,Ge,$e)=>{f(Ie,Ze,ot,Ut,Ae,$e,Ge)},de=bt(p.bands,jf).find(Ie=>Ie.series[0]==g),pe=de!=null?de.dir:0,ee=m.fillTo(p,g,m.min,m.max,pe),_e=z(_(ee,C,P,U)),ye,Re,we,qe=D,rt=z(m.width*At),We=!1,ft=null,lt=null,it=null,Yt=null;u!=null&&(rt==0||h!=null)&&(We=!0,ft=u.values(p,g,v,d),lt=new Map,new Set(ft).forEach(Ie=>{Ie!=null&&lt.set(Ie,new Path2D)}),rt>0&&(it=h.values(p,g,v,d),Yt=new Map,new Set(it).forEach(Ie=>{Ie!=null&&Yt.set(Ie,new Path2D)})));let{x0:Bt,size:rn}=c;if(Bt!=null&&rn!=null){V=1,y=Bt.values(p,g,v,d),Bt.unit==2&&(y=y.map(ot=>p.posToVal(b+ot*D,S.key,!0)));let Ie=rn.values(p,g,v,d);rn.unit==2?Re=Ie[0]*D:Re=E(Ie[0],S,D,b)-E(0,S,D,b),qe=Fg(y,T,E,S,D,b,qe),we=qe-Re+L}else qe=Fg(y,T,E,S,D,b,qe),we=qe*o+L,Re=qe-we;we<1&&(we=0),rt>=Re/2&&(rt=0),we<5&&(z=Xg);let Dt=we>0,An=qe-we-(Dt?rt:0);Re=z(kf(An,Z,H)),ye=(V==0?Re/2:V==Y?0:Re)-V*Y*((V==0?L/2:0)+(Dt?rt/2:0));let St={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},gn=We?null:new Path2D,Jt=null;if(de!=null)Jt=p.data[de.series[1]];else{let{y0:Ie,y1:Ze}=c;Ie!=null&&Ze!=null&&(T=Ze.values(p,g,v,d),Jt=Ie.values(p,g,v,d))}let on=k*Re,O=he*Re;for(let Ie=Y==1?v:d;Ie>=v&&Ie<=d;Ie+=Y){let Ze=T[Ie];if(Ze==null)continue;if(Jt!=null){let X=Jt[Ie]??0;if(Ze-X==0)continue;_e=_(X,C,P,U)}let ot=S.distr!=2||c!=null?y[Ie]:Ie,Ae=E(ot,S,D,b),Ut=_(bt(Ze,ee),C,P,U),Ge=z(Ae-ye),$e=z(Xn(Ut,_e)),R=z(Bi(Ut,_e)),M=$e-R;if(Ze!=null){let X=Ze<0?O:on,fe=Ze<0?on:O;We?(rt>0&&it[Ie]!=null&&Q(Yt.get(it[Ie]),Ge,R+fi(rt/2),Re,Xn(0,M-rt),X,fe),ft[Ie]!=null&&Q(lt.get(ft[Ie]),Ge,R+fi(rt/2),Re,Xn(0,M-rt),X,fe)):Q(gn,Ge,R+fi(rt/2),Re,Xn(0,M-rt),X,fe),ne(p,g,Ie,Ge-rt/2,R,Re+rt,M)}}return rt>0?St.stroke=We?Yt:gn:We||(St._fill=m.width==0?m._fill:m._stroke??m._fill,St.width=0),St.fill=We?lt:gn,St})}function Vw(i,e){let t=bt(e?.alignGaps,0);return(n,s,r,o)=>br(n,s,(a,l,c,f,u,h,p,g,v,d,m)=>{[r,o]=mh(c,r,o);let y=a.pxRound,T=k=>y(h(k,f,d,g)),S=k=>y(p(k,u,m,v)),C,E,_;f.ori==0?(C=yh,_=Eo,E=x0):(C=Sh,_=Co,E=v0);let b=f.dir*(f.ori==0?1:-1),U=T(l[b==1?r:o]),D=U,P=[],z=[];for(let k=b==1?r:o;k>=r&&k<=o;k+=b)if(c[k]!=null){let Y=l[k],Q=T(Y);P.push(D=Q),z.push(S(c[k]))}let V={stroke:i(P,z,C,_,E,y),fill:null,clip:null,band:null,gaps:null,flags:Ao},L=V.stroke,[H,Z]=id(n,s);if(a.fill!=null||H!=0){let k=V.fill=new Path2D(L),he=a.fillTo(n,s,a.min,a.max,H),Y=S(he);_(k,D,Y),_(k,U,Y)}if(!a.spanGaps){let k=[];k.push(...sd(l,c,r,o,b,T,t)),V.gaps=k=a.gaps(n,s,r,o,k),V.clip=vh(k,f.ori,g,v,d,m)}return Z!=0&&(V.band=Z==2?[bs(n,s,r,o,L,-1),bs(n,s,r,o,L,1)]:bs(n,s,r,o,L,Z)),V})}function Gw(i){return Vw(Hw,i)}function Hw(i,e,t,n,s,r){let o=i.length;if(o<2)return null;let a=new Path2D;if(t(a,i[0],e[0]),o==2)n(a,i[1],e[1]);else{let l=Array(o),c=Array(o-1),f=Array(o-1),u=Array(o-1);for(let h=0;h<o-1;h++)f[h]=e[h+1]-e[h],u[h]=i[h+1]-i[h],c[h]=f[h]/u[h];l[0]=c[0];for(let h=1;h<o-1;h++)c[h]===0||c[h-1]===0||c[h-1]>0!=c[h]>0?l[h]=0:(l[h]=3*(u[h-1]+u[h])/((2*u[h]+u[h-1])/c[h-1]+(u[h]+2*u[h-1])/c[h]),isFinite(l[h])||(l[h]=0));l[o-1]=c[o-2];for(let h=0;h<o-1;h++)s(a,i[h]+u[h]/3,e[h]+l[h]*u[h]/3,i[h+1]-u[h]/3,e[h+1]-l[h+1]*u[h]/3,i[h+1],e[h+1])}return a}var Wf=new Set;function Og(){for(let i of Wf)i.syncRect(!0)}To&&(Sr(bb,So,Og),Sr(wb,So,Og,!0),Sr(fh,So,()=>{Dn.pxRatio=At}));var Ww=M0(),Xw=y0();function Bg(i,e,t,n){return(n?[i[0],i[1]].concat(i.slice(2)):[i[0]].concat(i.slice(1))).map((r,o)=>Xf(r,o,e,t))}function qw(i,e){return i.map((t,n)=>n==0?{}:mn({},e,t))}function Xf(i,e,t,n){return mn({},e==0?t:n,i)}function b0(i,e,t){return e==null?bo:[e,t]}var Yw=b0;function $w(i,e,t){return e==null?bo:dh(e,t,Jf,!0)}function w0(i,e,t,n){return e==null?bo:gh(e,t,i.scales[n].log,!1)}var Zw=w0;function A0(i,e,t,n){return e==null?bo:Zf(e,t,i.scales[n].log,!1)}var Jw=A0;function Kw(i,e,t,n,s){let r=Xn(gg(i),gg(e)),o=e-i,a=Oi(s/n*o,t);do{let l=t[a],c=n*l/o;if(c>=s&&r+(l<5?qs.get(l):0)<=17)return[l,c]}while(++a<t.length);return[0,0]}function zg(i){let e,t;return i=i.replace(/(\d+)px/,(n,s)=>(e=Mn((t=+s)*At))+"px"),[i,e,t]}function jw(i){i.show&&[i.font,i.labelFont].forEach(e=>{let t=Ot(e[2]*At,1);e[0]=e[0].replace(/[0-9.]+px/,t+"px"),e[1]=t})}function Dn(i,e,t){let n={mode:bt(i.mode,1)},s=n.mode;function r(x,w,I,N){let G=w.valToPct(x);return N+I*(w.dir==-1?1-G:G)}function o(x,w,I,N){let G=w.valToPct(x);return N+I*(w.dir==-1?G:1-G)}function a(x,w,I,N){return w.ori==0?r(x,w,I,N):o(x,w,I,N)}n.valToPosH=r,n.valToPosV=o;let l=!1;n.status=0;let c=n.root=bi(rb);if(i.id!=null&&(c.id=i.id),ui(c,i.class),i.title){let x=bi(lb,c);x.textContent=i.title}let f=Fi("canvas"),u=n.ctx=f.getContext("2d"),h=bi(cb,c);Sr("click",h,x=>{x.target===g&&(Vt!=Ur||$t!=Fr)&&In.click(n,x)},!0);let p=n.under=bi(hb,h);h.appendChild(f);let g=n.over=bi(ub,h);i=wo(i);let v=+bt(i.pxAlign,1),d=Ug(v);(i.plugins||[]).forEach(x=>{x.opts&&(i=x.opts(n,i)||i)});let m=i.ms||.001,y=n.series=s==1?Bg(i.series||[],Cg,Dg,!1):qw(i.series||[null],Lg),T=n.axes=Bg(i.axes||[],Eg,Pg,!0),S=n.scales={},C=n.bands=i.bands||[];C.forEach(x=>{x.fill=vt(x.fill||null),x.dir=bt(x.dir,-1)});let E=s==2?y[1].facets[0].scale:y[0].scale,_={axes:ls,series:pt},b=(i.drawOrder||["axes","series"]).map(x=>_[x]);function U(x){let w=x.distr==3?I=>Ms(I>0?I:x.clamp(n,I,x.min,x.max,x.key)):x.distr==4?I=>Lf(I,x.asinh):x.distr==100?I=>x.fwd(I):I=>I;return I=>{let N=w(I),{_min:G,_max:J}=x,ce=J-G;return(N-G)/ce}}function D(x){let w=S[x];if(w==null){let I=(i.scales||Da)[x]||Da;if(I.from!=null){D(I.from);let N=mn({},S[I.from],I,{key:x});N.valToPct=U(N),S[x]=N}else{w=S[x]=mn({},x==E?d0:Nw,I),w.key=x;let N=w.time,G=w.range,J=Xs(G);if((x!=E||s==2&&!N)&&(J&&(G[0]==null||G[1]==null)&&(G={min:G[0]==null?dg:{mode:1,hard:G[0],soft:G[0]},max:G[1]==null?dg:{mode:1,hard:G[1],soft:G[1]}},J=!1),!J&&xh(G))){let ce=G;G=(me,Me,Ue)=>Me==null?bo:dh(Me,Ue,ce)}w.range=vt(G||(N?Yw:x==E?w.distr==3?Zw:w.distr==4?Jw:b0:w.distr==3?w0:w.distr==4?A0:$w)),w.auto=vt(J?!1:w.auto),w.clamp=vt(w.clamp||Dw),w._min=w._max=null,w.valToPct=U(w)}}}D("x"),D("y"),s==1&&y.forEach(x=>{D(x.scale)}),T.forEach(x=>{D(x.scale)});for(let x in i.scales)D(x);let P=S[E],z=P.distr,V,L;P.ori==0?(ui(c,ob),V=r,L=o):(ui(c,ab),V=o,L=r);let H={};for(let x in S){let w=S[x];(w.min!=null||w.max!=null)&&(H[x]={min:w.min,max:w.max},w.min=w.max=null)}let Z=i.tzDate||(x=>new Date(Mn(x/m))),k=i.fmtDate||Qf,he=m==1?ow(Z):cw(Z),Y=wg(Z,bg(m==1?rw:lw,k)),Q=Tg(Z,Ag(uw,k)),ne=[],de=n.legend=mn({},pw,i.legend),pe=n.cursor=mn({},yw,{drag:{y:s==2}},i.cursor),ee=de.show,_e=pe.show,ye=de.markers;de.idxs=ne,ye.width=vt(ye.width),ye.dash=vt(ye.dash),ye.stroke=vt(ye.stroke),ye.fill=vt(ye.fill);let Re,we,qe,rt=[],We=[],ft,lt=!1,it={};if(de.live){let x=y[1]?y[1].values:null;lt=x!=null,ft=lt?x(n,1,0):{_:0};for(let w in ft)it[w]=Yf}if(ee)if(Re=Fi("table",_b,c),qe=Fi("tbody",null,Re),de.mount(n,Re),lt){we=Fi("thead",null,Re,qe);let x=Fi("tr",null,we);Fi("th",null,x);for(var Yt in ft)Fi("th",eg,x).textContent=Yt}else ui(Re,vb),de.live&&ui(Re,xb);let Bt={show:!0},rn={show:!1};function Dt(x,w){if(w==0&&(lt||!de.live||s==2))return bo;let I=[],N=Fi("tr",yb,qe,qe.childNodes[w]);ui(N,x.class),x.show||ui(N,yr);let G=Fi("th",null,N);if(ye.show){let me=bi(Sb,G);if(w>0){let Me=ye.width(n,w);Me&&(me.style.border=Me+"px "+ye.dash(n,w)+" "+ye.stroke(n,w)),me.style.background=ye.fill(n,w)}}let J=bi(eg,G);x.label instanceof HTMLElement?J.appendChild(x.label):J.textContent=x.label,w>0&&(ye.show||(J.style.color=x.width>0?ye.stroke(n,w):ye.fill(n,w)),St("click",G,me=>{if(pe._lock)return;je(me);let Me=y.indexOf(x);if((me.ctrlKey||me.metaKey)!=de.isolate){let Ue=y.some((Fe,Be)=>Be>0&&Be!=Me&&Fe.show);y.forEach((Fe,Be)=>{Be>0&&Gi(Be,Ue?Be==Me?Bt:rn:Bt,!0,hn.setSeries)})}else Gi(Me,{show:!x.show},!0,hn.setSeries)},!1),Qe&&St(sg,G,me=>{pe._lock||(je(me),Gi(y.indexOf(x),Br,!0,hn.setSeries))},!1));for(var ce in ft){let me=Fi("td",Mb,N);me.textContent="--",I.push(me)}return[N,I]}let An=new Map;function St(x,w,I,N=!0){let G=An.get(w)||{},J=pe.bind[x](n,w,I,N);J&&(Sr(x,w,G[x]=J),An.set(w,G))}function gn(x,w,I){let N=An.get(w)||{};for(let G in N)(x==null||G==x)&&(zf(G,w,N[G]),delete N[G]);x==null&&An.delete(w)}let Jt=0,on=0,O=0,Ie=0,Ze=0,ot=0,Ae=Ze,Ut=ot,Ge=O,$e=Ie,R=0,M=0,X=0,fe=0;n.bbox={};let le=!1,ve=!1,Se=!1,ie=!1,oe=!1,ge=!1;function F(x,w,I){(I||x!=n.width||w!=n.height)&&ae(x,w),ct(!1),Se=!0,ve=!0,Nn()}function ae(x,w){n.width=Jt=O=x,n.height=on=Ie=w,Ze=ot=0,be(),Xe();let I=n.bbox;R=I.left=xr(Ze*At,.5),M=I.top=xr(ot*At,.5),X=I.width=xr(O*At,.5),fe=I.height=xr(Ie*At,.5)}let se=3;function Te(){let x=!1,w=0;for(;!x;){w++;let I=Lr(w),N=Vi(w);x=w==se||I&&N,x||(ae(n.width,n.height),ve=!0)}}function xe({width:x,height:w}){F(x,w)}n.setSize=xe;function be(){let x=!1,w=!1,I=!1,N=!1;T.forEach((G,J)=>{if(G.show&&G._show){let{side:ce,_size:me}=G,Me=ce%2,Ue=G.label!=null?G.labelSize:0,Fe=me+Ue;Fe>0&&(Me?(O-=Fe,ce==3?(Ze+=Fe,N=!0):I=!0):(Ie-=Fe,ce==0?(ot+=Fe,x=!0):w=!0))}}),zi[0]=x,zi[1]=I,zi[2]=w,zi[3]=N,O-=Ai[1]+Ai[3],Ze+=Ai[3],Ie-=Ai[2]+Ai[0],ot+=Ai[0]}function Xe(){let x=Ze+O,w=ot+Ie,I=Ze,N=ot;function G(J,ce){switch(J){case 1:return x+=ce,x-ce;case 2:return w+=ce,w-ce;case 3:return I-=ce,I+ce;case 0:return N-=ce,N+ce}}T.forEach((J,ce)=>{if(J.show&&J._show){let me=J.side;J._pos=G(me,J._size),J.label!=null&&(J._lpos=G(me,J.labelSize))}})}if(pe.dataIdx==null){let x=pe.hover,w=x.skip=new Set(x.skip??[]);w.add(void 0);let I=x.prox=vt(x.prox),N=x.bias??=0;pe.dataIdx=(G,J,ce,me)=>{if(J==0)return ce;let Me=ce,Ue=I(G,J,ce,me)??Ft,Fe=Ue>=0&&Ue<Ft,Be=P.ori==0?O:Ie,st=pe.left,wt=e[0],Mt=e[J];if(w.has(Mt[ce])){Me=null;let gt=null,Ke=null,Ye;if(N==0||N==-1)for(Ye=ce;gt==null&&Ye-- >0;)w.has(Mt[Ye])||(gt=Ye);if(N==0||N==1)for(Ye=ce;Ke==null&&Ye++<Mt.length;)w.has(Mt[Ye])||(Ke=Ye);if(gt!=null||Ke!=null)if(Fe){let Ht=gt==null?-1/0:V(wt[gt],P,Be,0),Qt=Ke==null?1/0:V(wt[Ke],P,Be,0),Rn=st-Ht,Nt=Qt-st;Rn<=Nt?Rn<=Ue&&(Me=gt):Nt<=Ue&&(Me=Ke)}else Me=Ke==null?gt:gt==null?Ke:ce-gt<=Ke-ce?gt:Ke}else Fe&&bn(st-V(wt[ce],P,Be,0))>Ue&&(Me=null);return Me}}let je=x=>{pe.event=x};pe.idxs=ne,pe._lock=!1;let ue=pe.points;ue.show=vt(ue.show),ue.size=vt(ue.size),ue.stroke=vt(ue.stroke),ue.width=vt(ue.width),ue.fill=vt(ue.fill);let ze=n.focus=mn({},i.focus||{alpha:.3},pe.focus),Qe=ze.prox>=0,Pe=Qe&&ue.one,at=[],kt=[],zn=[];function No(x,w){let I=ue.show(n,w);if(I instanceof HTMLElement)return ui(I,gb),ui(I,x.class),ns(I,-10,-10,O,Ie),g.insertBefore(I,at[w]),I}function Rr(x,w){if(s==1||w>0){let I=s==1&&S[x.scale].time,N=x.value;x.value=I?vg(N)?Tg(Z,Ag(N,k)):N||Q:N||Pw,x.label=x.label||(I?Mw:Sw)}if(Pe||w>0){x.width=x.width==null?1:x.width,x.paths=x.paths||Ww||Nb,x.fillTo=vt(x.fillTo||Uw),x.pxAlign=+bt(x.pxAlign,v),x.pxRound=Ug(x.pxAlign),x.stroke=vt(x.stroke||null),x.fill=vt(x.fill||null),x._stroke=x._fill=x._paths=x._focus=null;let I=Iw(Xn(1,x.width),1),N=x.points=mn({},{size:I,width:Xn(1,I*.2),stroke:x.stroke,space:I*2,paths:Xw,_stroke:null,_fill:null},x.points);N.show=vt(N.show),N.filter=vt(N.filter),N.fill=vt(N.fill),N.stroke=vt(N.stroke),N.paths=vt(N.paths),N.pxAlign=x.pxAlign}if(ee){let I=Dt(x,w);rt.splice(w,0,I[0]),We.splice(w,0,I[1]),de.values.push(null)}if(_e){ne.splice(w,0,null);let I=null;Pe?w==0&&(I=No(x,w)):w>0&&(I=No(x,w)),at.splice(w,0,I),kt.splice(w,0,0),zn.splice(w,0,0)}Cn("addSeries",w)}function Bh(x,w){w=w??y.length,x=s==1?Xf(x,w,Cg,Dg):Xf(x,w,{},Lg),y.splice(w,0,x),Rr(y[w],w)}n.addSeries=Bh;function Xa(x){if(y.splice(x,1),ee){de.values.splice(x,1),We.splice(x,1);let w=rt.splice(x,1)[0];gn(null,w.firstChild),w.remove()}_e&&(ne.splice(x,1),at.splice(x,1)[0].remove(),kt.splice(x,1),zn.splice(x,1)),Cn("delSeries",x)}n.delSeries=Xa;let zi=[!1,!1,!1,!1];function rs(x,w){if(x._show=x.show,x.show){let I=x.side%2,N=S[x.scale];N==null&&(x.scale=I?y[1].scale:E,N=S[x.scale]);let G=N.time;x.size=vt(x.size),x.space=vt(x.space),x.rotate=vt(x.rotate),Xs(x.incrs)&&x.incrs.forEach(ce=>{!qs.has(ce)&&qs.set(ce,$g(ce))}),x.incrs=vt(x.incrs||(N.distr==2?nw:G?m==1?sw:aw:vr)),x.splits=vt(x.splits||(G&&N.distr==1?he:N.distr==3?Vf:N.distr==4?Aw:ww)),x.stroke=vt(x.stroke),x.grid.stroke=vt(x.grid.stroke),x.ticks.stroke=vt(x.ticks.stroke),x.border.stroke=vt(x.border.stroke);let J=x.values;x.values=Xs(J)&&!Xs(J[0])?vt(J):G?Xs(J)?wg(Z,bg(J,k)):vg(J)?hw(Z,J):J||Y:J||bw,x.filter=vt(x.filter||(N.distr>=3&&N.log==10?Cw:N.distr==3&&N.log==2?Rw:qg)),x.font=zg(x.font),x.labelFont=zg(x.labelFont),x._size=x.size(n,null,w,0),x._space=x._rotate=x._incrs=x._found=x._splits=x._values=null,x._size>0&&(zi[w]=!0,x._el=bi(fb,h))}}function os(x,w,I,N){let[G,J,ce,me]=I,Me=w%2,Ue=0;return Me==0&&(me||J)&&(Ue=w==0&&!G||w==2&&!ce?Mn(Eg.size/3):0),Me==1&&(G||ce)&&(Ue=w==1&&!J||w==3&&!me?Mn(Pg.size/2):0),Ue}let Uo=n.padding=(i.padding||[os,os,os,os]).map(x=>vt(bt(x,os))),Ai=n._padding=Uo.map((x,w)=>x(n,w,zi,0)),Kt,nn=null,sn=null,ki=s==1?y[0].idxs:null,jn=null,As=!1;function Fo(x,w){if(e=x??[],n.data=n._data=e,s==2){Kt=0;for(let I=1;I<y.length;I++)Kt+=e[I][0].length}else{e.length==0&&(n.data=n._data=e=[[]]),jn=e[0],Kt=jn.length;let I=e;if(z==2){I=e.slice();let N=I[0]=Array(Kt);for(let G=0;G<Kt;G++)N[G]=G}n._data=e=I}if(ct(!0),Cn("setData"),z==2&&(Se=!0),w!==!1){let I=P;I.auto(n,As)?Oo():Cs(E,I.min,I.max),ie=ie||pe.left>=0,ge=!0,Nn()}}n.setData=Fo;function Oo(){As=!0;let x,w;s==1&&(Kt>0?(nn=ki[0]=0,sn=ki[1]=Kt-1,x=e[0][nn],w=e[0][sn],z==2?(x=nn,w=sn):x==w&&(z==3?[x,w]=gh(x,x,P.log,!1):z==4?[x,w]=Zf(x,x,P.log,!1):P.time?w=x+Mn(86400/m):[x,w]=dh(x,w,Jf,!0))):(nn=ki[0]=x=null,sn=ki[1]=w=null)),Cs(E,x,w)}let Pr,Ts,Ir,A,B,K,q,$,Ee,Le;function Ce(x,w,I,N,G,J){x??=ng,I??=jf,N??="butt",G??=ng,J??="round",x!=Pr&&(u.strokeStyle=Pr=x),G!=Ts&&(u.fillStyle=Ts=G),w!=Ir&&(u.lineWidth=Ir=w),J!=B&&(u.lineJoin=B=J),N!=K&&(u.lineCap=K=N),I!=A&&u.setLineDash(A=I)}function De(x,w,I,N){w!=Ts&&(u.fillStyle=Ts=w),x!=q&&(u.font=q=x),I!=$&&(u.textAlign=$=I),N!=Ee&&(u.textBaseline=Ee=N)}function Ve(x,w,I,N,G=0){if(N.length>0&&x.auto(n,As)&&(w==null||w.min==null)){let J=bt(nn,0),ce=bt(sn,N.length-1),me=I.min==null?Cb(N,J,ce,G,x.distr==3):[I.min,I.max];x.min=Bi(x.min,I.min=me[0]),x.max=Xn(x.max,I.max=me[1])}}let tt={min:null,max:null};function dt(){for(let N in S){let G=S[N];H[N]==null&&(G.min==null||H[E]!=null&&G.auto(n,As))&&(H[N]=tt)}for(let N in S){let G=S[N];H[N]==null&&G.from!=null&&H[G.from]!=null&&(H[N]=tt)}H[E]!=null&&ct(!0);let x={};for(let N in H){let G=H[N];if(G!=null){let J=x[N]=wo(S[N],Ob);if(G.min!=null)mn(J,G);else if(N!=E||s==2)if(Kt==0&&J.from==null){let ce=J.range(n,null,null,N);J.min=ce[0],J.max=ce[1]}else J.min=Ft,J.max=-Ft}}if(Kt>0){y.forEach((N,G)=>{if(s==1){let J=N.scale,ce=H[J];if(ce==null)return;let me=x[J];if(G==0){let Me=me.range(n,me.min,me.max,J);me.min=Me[0],me.max=Me[1],nn=Oi(me.min,e[0]),sn=Oi(me.max,e[0]),sn-nn>1&&(e[0][nn]<me.min&&nn++,e[0][sn]>me.max&&sn--),N.min=jn[nn],N.max=jn[sn]}else N.show&&N.auto&&Ve(me,ce,N,e[G],N.sorted);N.idxs[0]=nn,N.idxs[1]=sn}else if(G>0&&N.show&&N.auto){let[J,ce]=N.facets,me=J.scale,Me=ce.scale,[Ue,Fe]=e[G],Be=x[me],st=x[Me];Be!=null&&Ve(Be,H[me],J,Ue,J.sorted),st!=null&&Ve(st,H[Me],ce,Fe,ce.sorted),N.min=ce.min,N.max=ce.max}});for(let N in x){let G=x[N],J=H[N];if(G.from==null&&(J==null||J.min==null)){let ce=G.range(n,G.min==Ft?null:G.min,G.max==-Ft?null:G.max,N);G.min=ce[0],G.max=ce[1]}}}for(let N in x){let G=x[N];if(G.from!=null){let J=x[G.from];if(J.min==null)G.min=G.max=null;else{let ce=G.range(n,J.min,J.max,N);G.min=ce[0],G.max=ce[1]}}}let w={},I=!1;for(let N in x){let G=x[N],J=S[N];if(J.min!=G.min||J.max!=G.max){J.min=G.min,J.max=G.max;let ce=J.distr;J._min=ce==3?Ms(J.min):ce==4?Lf(J.min,J.asinh):ce==100?J.fwd(J.min):J.min,J._max=ce==3?Ms(J.max):ce==4?Lf(J.max,J.asinh):ce==100?J.fwd(J.max):J.max,w[N]=I=!0}}if(I){y.forEach((N,G)=>{s==2?G>0&&w.y&&(N._paths=null):w[N.scale]&&(N._paths=null)});for(let N in w)Se=!0,Cn("setScale",N);_e&&pe.left>=0&&(ie=ge=!0)}for(let N in H)H[N]=null}function ke(x){let w=kf(nn-1,0,Kt-1),I=kf(sn+1,0,Kt-1);for(;x[w]==null&&w>0;)w--;for(;x[I]==null&&I<Kt-1;)I++;return[w,I]}function pt(){if(Kt>0){let x=y.some(w=>w._focus)&&Le!=ze.alpha;x&&(u.globalAlpha=Le=ze.alpha),y.forEach((w,I)=>{if(I>0&&w.show&&(Zt(I,!1),Zt(I,!0),w._paths==null)){let N=Le;Le!=w.alpha&&(u.globalAlpha=Le=w.alpha);let G=s==2?[0,e[I][0].length-1]:ke(e[I]);w._paths=w.paths(n,I,G[0],G[1]),Le!=N&&(u.globalAlpha=Le=N)}}),y.forEach((w,I)=>{if(I>0&&w.show){let N=Le;Le!=w.alpha&&(u.globalAlpha=Le=w.alpha),w._paths!=null&&Ct(I,!1);{let G=w._paths!=null?w._paths.gaps:null,J=w.points.show(n,I,nn,sn,G),ce=w.points.filter(n,I,J,G);(J||ce)&&(w.points._paths=w.points.paths(n,I,nn,sn,ce),Ct(I,!0))}Le!=N&&(u.globalAlpha=Le=N),Cn("drawSeries",I)}}),x&&(u.globalAlpha=Le=1)}}function Zt(x,w){let I=w?y[x].points:y[x];I._stroke=I.stroke(n,x),I._fill=I.fill(n,x)}function Ct(x,w){let I=w?y[x].points:y[x],{stroke:N,fill:G,clip:J,flags:ce,_stroke:me=I._stroke,_fill:Me=I._fill,_width:Ue=I.width}=I._paths;Ue=Ot(Ue*At,3);let Fe=null,Be=Ue%2/2;w&&Me==null&&(Me=Ue>0?"#fff":me);let st=I.pxAlign==1&&Be>0;if(st&&u.translate(Be,Be),!w){let wt=R-Ue/2,Mt=M-Ue/2,gt=X+Ue,Ke=fe+Ue;Fe=new Path2D,Fe.rect(wt,Mt,gt,Ke)}w?Oe(me,Ue,I.dash,I.cap,Me,N,G,ce,J):Rt(x,me,Ue,I.dash,I.cap,Me,N,G,ce,Fe,J),st&&u.translate(-Be,-Be)}function Rt(x,w,I,N,G,J,ce,me,Me,Ue,Fe){let Be=!1;Me!=0&&C.forEach((st,wt)=>{if(st.series[0]==x){let Mt=y[st.series[1]],gt=e[st.series[1]],Ke=(Mt._paths||Da).band;Xs(Ke)&&(Ke=st.dir==1?Ke[0]:Ke[1]);let Ye,Ht=null;Mt.show&&Ke&&Pb(gt,nn,sn)?(Ht=st.fill(n,wt)||J,Ye=Mt._paths.clip):Ke=null,Oe(w,I,N,G,Ht,ce,me,Me,Ue,Fe,Ye,Ke),Be=!0}}),Be||Oe(w,I,N,G,J,ce,me,Me,Ue,Fe)}let _n=Ao|Hf;function Oe(x,w,I,N,G,J,ce,me,Me,Ue,Fe,Be){Ce(x,w,I,N,G),(Me||Ue||Be)&&(u.save(),Me&&u.clip(Me),Ue&&u.clip(Ue)),Be?(me&_n)==_n?(u.clip(Be),Fe&&u.clip(Fe),_t(G,ce),an(x,J,w)):me&Hf?(_t(G,ce),u.clip(Be),an(x,J,w)):me&Ao&&(u.save(),u.clip(Be),Fe&&u.clip(Fe),_t(G,ce),u.restore(),an(x,J,w)):(_t(G,ce),an(x,J,w)),(Me||Ue||Be)&&u.restore()}function an(x,w,I){I>0&&(w instanceof Map?w.forEach((N,G)=>{u.strokeStyle=Pr=G,u.stroke(N)}):w!=null&&x&&u.stroke(w))}function _t(x,w){w instanceof Map?w.forEach((I,N)=>{u.fillStyle=Ts=N,u.fill(I)}):w!=null&&x&&u.fill(w)}function as(x,w,I,N){let G=T[x],J;if(N<=0)J=[0,0];else{let ce=G._space=G.space(n,x,w,I,N),me=G._incrs=G.incrs(n,x,w,I,N,ce);J=Kw(w,I,me,N,ce)}return G._found=J}function ln(x,w,I,N,G,J,ce,me,Me,Ue){let Fe=ce%2/2;v==1&&u.translate(Fe,Fe),Ce(me,ce,Me,Ue,me),u.beginPath();let Be,st,wt,Mt,gt=G+(N==0||N==3?-J:J);I==0?(st=G,Mt=gt):(Be=G,wt=gt);for(let Ke=0;Ke<x.length;Ke++)w[Ke]!=null&&(I==0?Be=wt=x[Ke]:st=Mt=x[Ke],u.moveTo(Be,st),u.lineTo(wt,Mt));u.stroke(),v==1&&u.translate(-Fe,-Fe)}function Lr(x){let w=!0;return T.forEach((I,N)=>{if(!I.show)return;let G=S[I.scale];if(G.min==null){I._show&&(w=!1,I._show=!1,ct(!1));return}else I._show||(w=!1,I._show=!0,ct(!1));let J=I.side,ce=J%2,{min:me,max:Me}=G,[Ue,Fe]=as(N,me,Me,ce==0?O:Ie);if(Fe==0)return;let Be=G.distr==2,st=I._splits=I.splits(n,N,me,Me,Ue,Fe,Be),wt=G.distr==2?st.map(Ye=>jn[Ye]):st,Mt=G.distr==2?jn[st[1]]-jn[st[0]]:Ue,gt=I._values=I.values(n,I.filter(n,wt,N,Fe,Mt),N,Fe,Mt);I._rotate=J==2?I.rotate(n,gt,N,Fe):0;let Ke=I._size;I._size=wi(I.size(n,gt,N,x)),Ke!=null&&I._size!=Ke&&(w=!1)}),w}function Vi(x){let w=!0;return Uo.forEach((I,N)=>{let G=I(n,N,zi,x);G!=Ai[N]&&(w=!1),Ai[N]=G}),w}function ls(){for(let x=0;x<T.length;x++){let w=T[x];if(!w.show||!w._show)continue;let I=w.side,N=I%2,G,J,ce=w.stroke(n,x),me=I==0||I==3?-1:1,[Me,Ue]=w._found;if(w.label!=null){let Gn=w.labelGap*me,ti=Mn((w._lpos+Gn)*At);De(w.labelFont[0],ce,"center",I==2?"top":tg),u.save(),N==1?(G=J=0,u.translate(ti,Mn(M+fe/2)),u.rotate((I==3?-uh:uh)/2)):(G=Mn(R+X/2),J=ti);let js=Wg(w.label)?w.label(n,x,Me,Ue):w.label;u.fillText(js,G,J),u.restore()}if(Ue==0)continue;let Fe=S[w.scale],Be=N==0?X:fe,st=N==0?R:M,wt=w._splits,Mt=Fe.distr==2?wt.map(Gn=>jn[Gn]):wt,gt=Fe.distr==2?jn[wt[1]]-jn[wt[0]]:Me,Ke=w.ticks,Ye=w.border,Ht=Ke.show?Ke.size:0,Qt=Mn(Ht*At),Rn=Mn((w.alignTo==2?w._size-Ht-w.gap:w.gap)*At),Nt=w._rotate*-uh/180,en=d(w._pos*At),Qn=(Qt+Rn)*me,Vn=en+Qn;J=N==0?Vn:0,G=N==1?Vn:0;let mi=w.font[0],Ti=w.align==1?vo:w.align==2?Rf:Nt>0?vo:Nt<0?Rf:N==0?"center":I==3?Rf:vo,Wi=Nt||N==1?"middle":I==2?"top":tg;De(mi,ce,Ti,Wi);let ei=w.font[1]*w.lineGap,gi=wt.map(Gn=>d(a(Gn,Fe,Be,st))),Ei=w._values;for(let Gn=0;Gn<Ei.length;Gn++){let ti=Ei[Gn];if(ti!=null){N==0?G=gi[Gn]:J=gi[Gn],ti=""+ti;let js=ti.indexOf(`
`)==-1?[ti]:ti.split(/\n/gm);for(let Hn=0;Hn<js.length;Hn++){let Bd=js[Hn];Nt?(u.save(),u.translate(G,J+Hn*ei),u.rotate(Nt),u.fillText(Bd,0,0),u.restore()):u.fillText(Bd,G,J+Hn*ei)}}}Ke.show&&ln(gi,Ke.filter(n,Mt,x,Ue,gt),N,I,en,Qt,Ot(Ke.width*At,3),Ke.stroke(n,x),Ke.dash,Ke.cap);let Xi=w.grid;Xi.show&&ln(gi,Xi.filter(n,Mt,x,Ue,gt),N,N==0?2:1,N==0?M:R,N==0?fe:X,Ot(Xi.width*At,3),Xi.stroke(n,x),Xi.dash,Xi.cap),Ye.show&&ln([en],[1],N==0?1:0,N==0?1:2,N==1?M:R,N==1?fe:X,Ot(Ye.width*At,3),Ye.stroke(n,x),Ye.dash,Ye.cap)}Cn("drawAxes")}function ct(x){y.forEach((w,I)=>{I>0&&(w._paths=null,x&&(s==1?(w.min=null,w.max=null):w.facets.forEach(N=>{N.min=null,N.max=null})))})}let jt=!1,kn=!1,Pt=[];function cn(){kn=!1;for(let x=0;x<Pt.length;x++)Cn(...Pt[x]);Pt.length=0}function Nn(){jt||(Wb(yd),jt=!0)}function qa(x,w=!1){jt=!0,kn=w,x(n),yd(),w&&Pt.length>0&&queueMicrotask(cn)}n.batch=qa;function yd(){if(le&&(dt(),le=!1),Se&&(Te(),Se=!1),ve){if(qt(p,vo,Ze),qt(p,"top",ot),qt(p,Ra,O),qt(p,Pa,Ie),qt(g,vo,Ze),qt(g,"top",ot),qt(g,Ra,O),qt(g,Pa,Ie),qt(h,Ra,Jt),qt(h,Pa,on),f.width=Mn(Jt*At),f.height=Mn(on*At),T.forEach(({_el:x,_show:w,_size:I,_pos:N,side:G})=>{if(x!=null)if(w){let J=G===3||G===0?I:0,ce=G%2==1;qt(x,ce?"left":"top",N-J),qt(x,ce?"width":"height",I),qt(x,ce?"top":"left",ce?ot:Ze),qt(x,ce?"height":"width",ce?Ie:O),Bf(x,yr)}else ui(x,yr)}),Pr=Ts=Ir=B=K=q=$=Ee=A=null,Le=1,ko(!0),Ze!=Ae||ot!=Ut||O!=Ge||Ie!=$e){ct(!1);let x=O/Ge,w=Ie/$e;if(_e&&!ie&&pe.left>=0){pe.left*=x,pe.top*=w,Dr&&ns(Dr,Mn(pe.left),0,O,Ie),Nr&&ns(Nr,0,Mn(pe.top),O,Ie);for(let I=0;I<at.length;I++){let N=at[I];N!=null&&(kt[I]*=x,zn[I]*=w,ns(N,wi(kt[I]),wi(zn[I]),O,Ie))}}if(Gt.show&&!oe&&Gt.left>=0&&Gt.width>0){Gt.left*=x,Gt.width*=x,Gt.top*=w,Gt.height*=w;for(let I in Wh)qt(Or,I,Gt[I])}Ae=Ze,Ut=ot,Ge=O,$e=Ie}Cn("setSize"),ve=!1}Jt>0&&on>0&&(u.clearRect(0,0,f.width,f.height),Cn("drawClear"),b.forEach(x=>x()),Cn("draw")),Gt.show&&oe&&(Ya(Gt),oe=!1),_e&&ie&&(Ks(null,!0,!1),ie=!1),de.show&&de.live&&ge&&(Gh(),ge=!1),l||(l=!0,n.status=1,Cn("ready")),As=!1,jt=!1}n.redraw=(x,w)=>{Se=w||!1,x!==!1?Cs(E,P.min,P.max):Nn()};function zh(x,w){let I=S[x];if(I.from==null){if(Kt==0){let N=I.range(n,w.min,w.max,x);w.min=N[0],w.max=N[1]}if(w.min>w.max){let N=w.min;w.min=w.max,w.max=N}if(Kt>1&&w.min!=null&&w.max!=null&&w.max-w.min<1e-16)return;x==E&&I.distr==2&&Kt>0&&(w.min=Oi(w.min,e[0]),w.max=Oi(w.max,e[0]),w.min==w.max&&w.max++),H[x]=w,le=!0,Nn()}}n.setScale=zh;let kh,Vh,Dr,Nr,Sd,Md,Ur,Fr,bd,wd,Vt,$t,Es=!1,In=pe.drag,Tn=In.x,En=In.y;_e&&(pe.x&&(kh=bi(pb,g)),pe.y&&(Vh=bi(mb,g)),P.ori==0?(Dr=kh,Nr=Vh):(Dr=Vh,Nr=kh),Vt=pe.left,$t=pe.top);let Gt=n.select=mn({show:!0,over:!0,left:0,width:0,top:0,height:0},i.select),Or=Gt.show?bi(db,Gt.over?g:p):null;function Ya(x,w){if(Gt.show){for(let I in x)Gt[I]=x[I],I in Wh&&qt(Or,I,x[I]);w!==!1&&Cn("setSelect")}}n.setSelect=Ya;function s_(x){if(y[x].show)ee&&Bf(rt[x],yr);else if(ee&&ui(rt[x],yr),_e){let I=Pe?at[0]:at[x];I!=null&&ns(I,-10,-10,O,Ie)}}function Cs(x,w,I){zh(x,{min:w,max:I})}function Gi(x,w,I,N){w.focus!=null&&c_(x),w.show!=null&&y.forEach((G,J)=>{J>0&&(x==J||x==null)&&(G.show=w.show,s_(J),s==2?(Cs(G.facets[0].scale,null,null),Cs(G.facets[1].scale,null,null)):Cs(G.scale,null,null),Nn())}),I!==!1&&Cn("setSeries",x,w),N&&Vo("setSeries",n,x,w)}n.setSeries=Gi;function r_(x,w){mn(C[x],w)}function o_(x,w){x.fill=vt(x.fill||null),x.dir=bt(x.dir,-1),w=w??C.length,C.splice(w,0,x)}function a_(x){x==null?C.length=0:C.splice(x,1)}n.addBand=o_,n.setBand=r_,n.delBand=a_;function l_(x,w){y[x].alpha=w,_e&&at[x]!=null&&(at[x].style.opacity=w),ee&&rt[x]&&(rt[x].style.opacity=w)}let cs,Rs,Js,Br={focus:!0};function c_(x){if(x!=Js){let w=x==null,I=ze.alpha!=1;y.forEach((N,G)=>{if(s==1||G>0){let J=w||G==0||G==x;N._focus=w?null:J,I&&l_(G,J?1:ze.alpha)}}),Js=x,I&&Nn()}}ee&&Qe&&St(rg,Re,x=>{pe._lock||(je(x),Js!=null&&Gi(null,Br,!0,hn.setSeries))});function Hi(x,w,I){let N=S[w];I&&(x=x/At-(N.ori==1?ot:Ze));let G=O;N.ori==1&&(G=Ie,x=G-x),N.dir==-1&&(x=G-x);let J=N._min,ce=N._max,me=x/G,Me=J+(ce-J)*me,Ue=N.distr;return Ue==3?Mo(10,Me):Ue==4?Lb(Me,N.asinh):Ue==100?N.bwd(Me):Me}function h_(x,w){let I=Hi(x,E,w);return Oi(I,e[0],nn,sn)}n.valToIdx=x=>Oi(x,e[0]),n.posToIdx=h_,n.posToVal=Hi,n.valToPos=(x,w,I)=>S[w].ori==0?r(x,S[w],I?X:O,I?R:0):o(x,S[w],I?fe:Ie,I?M:0),n.setCursor=(x,w,I)=>{Vt=x.left,$t=x.top,Ks(null,w,I)};function Ad(x,w){qt(Or,vo,Gt.left=x),qt(Or,Ra,Gt.width=w)}function Td(x,w){qt(Or,"top",Gt.top=x),qt(Or,Pa,Gt.height=w)}let Bo=P.ori==0?Ad:Td,zo=P.ori==1?Ad:Td;function u_(){if(ee&&de.live)for(let x=s==2?1:0;x<y.length;x++){if(x==0&&lt)continue;let w=de.values[x],I=0;for(let N in w)We[x][I++].firstChild.nodeValue=w[N]}}function Gh(x,w){if(x!=null&&(x.idxs?x.idxs.forEach((I,N)=>{ne[N]=I}):Fb(x.idx)||ne.fill(x.idx),de.idx=ne[0]),ee&&de.live){for(let I=0;I<y.length;I++)(I>0||s==1&&!lt)&&f_(I,ne[I]);u_()}ge=!1,w!==!1&&Cn("setLegend")}n.setLegend=Gh;function f_(x,w){let I=y[x],N=x==0&&z==2?jn:e[x],G;lt?G=I.values(n,x,w)??it:(G=I.value(n,w==null?null:N[w],x,w),G=G==null?it:{_:G}),de.values[x]=G}function Ks(x,w,I){bd=Vt,wd=$t,[Vt,$t]=pe.move(n,Vt,$t),pe.left=Vt,pe.top=$t,_e&&(Dr&&ns(Dr,Mn(Vt),0,O,Ie),Nr&&ns(Nr,0,Mn($t),O,Ie));let N,G=nn>sn;cs=Ft,Rs=null;let J=P.ori==0?O:Ie,ce=P.ori==1?O:Ie;if(Vt<0||Kt==0||G){N=pe.idx=null;for(let me=0;me<y.length;me++){let Me=at[me];Me!=null&&ns(Me,-10,-10,O,Ie)}Qe&&Gi(null,Br,!0,x==null&&hn.setSeries),de.live&&(ne.fill(N),ge=!0)}else{let me,Me,Ue;s==1&&(me=P.ori==0?Vt:$t,Me=Hi(me,E),N=pe.idx=Oi(Me,e[0],nn,sn),Ue=V(e[0][N],P,J,0));let Fe=-10,Be=-10,st=0,wt=0,Mt=!0,gt="",Ke="";for(let Ye=s==2?1:0;Ye<y.length;Ye++){let Ht=y[Ye],Qt=ne[Ye],Rn=Qt==null?null:s==1?e[Ye][Qt]:e[Ye][1][Qt],Nt=pe.dataIdx(n,Ye,N,Me),en=Nt==null?null:s==1?e[Ye][Nt]:e[Ye][1][Nt];if(ge=ge||en!=Rn||Nt!=Qt,ne[Ye]=Nt,Ye>0&&Ht.show){let Qn=Nt==null?-10:Nt==N?Ue:V(s==1?e[0][Nt]:e[Ye][0][Nt],P,J,0),Vn=en==null?-10:L(en,s==1?S[Ht.scale]:S[Ht.facets[1].scale],ce,0);if(Qe&&en!=null){let mi=P.ori==1?Vt:$t,Ti=bn(ze.dist(n,Ye,Nt,Vn,mi));if(Ti<cs){let Wi=ze.bias;if(Wi!=0){let ei=Hi(mi,Ht.scale),gi=en>=0?1:-1,Ei=ei>=0?1:-1;Ei==gi&&(Ei==1?Wi==1?en>=ei:en<=ei:Wi==1?en<=ei:en>=ei)&&(cs=Ti,Rs=Ye)}else cs=Ti,Rs=Ye}}if(ge||Pe){let mi,Ti;P.ori==0?(mi=Qn,Ti=Vn):(mi=Vn,Ti=Qn);let Wi,ei,gi,Ei,Xi,Gn,ti=!0,js=ue.bbox;if(js!=null){ti=!1;let Hn=js(n,Ye);gi=Hn.left,Ei=Hn.top,Wi=Hn.width,ei=Hn.height}else gi=mi,Ei=Ti,Wi=ei=ue.size(n,Ye);if(Gn=ue.fill(n,Ye),Xi=ue.stroke(n,Ye),Pe)Ye==Rs&&cs<=ze.prox&&(Fe=gi,Be=Ei,st=Wi,wt=ei,Mt=ti,gt=Gn,Ke=Xi);else{let Hn=at[Ye];Hn!=null&&(kt[Ye]=gi,zn[Ye]=Ei,fg(Hn,Wi,ei,ti),hg(Hn,Gn,Xi),ns(Hn,wi(gi),wi(Ei),O,Ie))}}}}if(Pe){let Ye=ze.prox,Ht=Js==null?cs<=Ye:cs>Ye||Rs!=Js;if(ge||Ht){let Qt=at[0];Qt!=null&&(kt[0]=Fe,zn[0]=Be,fg(Qt,st,wt,Mt),hg(Qt,gt,Ke),ns(Qt,wi(Fe),wi(Be),O,Ie))}}}if(Gt.show&&Es)if(x!=null){let[me,Me]=hn.scales,[Ue,Fe]=hn.match,[Be,st]=x.cursor.sync.scales,wt=x.cursor.drag;if(Tn=wt._x,En=wt._y,Tn||En){let{left:Mt,top:gt,width:Ke,height:Ye}=x.select,Ht=x.scales[Be].ori,Qt=x.posToVal,Rn,Nt,en,Qn,Vn,mi=me!=null&&Ue(me,Be),Ti=Me!=null&&Fe(Me,st);mi&&Tn?(Ht==0?(Rn=Mt,Nt=Ke):(Rn=gt,Nt=Ye),en=S[me],Qn=V(Qt(Rn,Be),en,J,0),Vn=V(Qt(Rn+Nt,Be),en,J,0),Bo(Bi(Qn,Vn),bn(Vn-Qn))):Bo(0,J),Ti&&En?(Ht==1?(Rn=Mt,Nt=Ke):(Rn=gt,Nt=Ye),en=S[Me],Qn=L(Qt(Rn,st),en,ce,0),Vn=L(Qt(Rn+Nt,st),en,ce,0),zo(Bi(Qn,Vn),bn(Vn-Qn))):zo(0,ce)}else Xh()}else{let me=bn(bd-Sd),Me=bn(wd-Md);if(P.ori==1){let st=me;me=Me,Me=st}Tn=In.x&&me>=In.dist,En=In.y&&Me>=In.dist;let Ue=In.uni;Ue!=null?Tn&&En&&(Tn=me>=Ue,En=Me>=Ue,!Tn&&!En&&(Me>me?En=!0:Tn=!0)):In.x&&In.y&&(Tn||En)&&(Tn=En=!0);let Fe,Be;Tn&&(P.ori==0?(Fe=Ur,Be=Vt):(Fe=Fr,Be=$t),Bo(Bi(Fe,Be),bn(Be-Fe)),En||zo(0,ce)),En&&(P.ori==1?(Fe=Ur,Be=Vt):(Fe=Fr,Be=$t),zo(Bi(Fe,Be),bn(Be-Fe)),Tn||Bo(0,J)),!Tn&&!En&&(Bo(0,0),zo(0,0))}if(In._x=Tn,In._y=En,x==null){if(I){if(Od!=null){let[me,Me]=hn.scales;hn.values[0]=me!=null?Hi(P.ori==0?Vt:$t,me):null,hn.values[1]=Me!=null?Hi(P.ori==1?Vt:$t,Me):null}Vo(Pf,n,Vt,$t,O,Ie,N)}if(Qe){let me=I&&hn.setSeries,Me=ze.prox;Js==null?cs<=Me&&Gi(Rs,Br,!0,me):cs>Me?Gi(null,Br,!0,me):Rs!=Js&&Gi(Rs,Br,!0,me)}}ge&&(de.idx=N,Gh()),w!==!1&&Cn("setCursor")}let Ps=null;Object.defineProperty(n,"rect",{get(){return Ps==null&&ko(!1),Ps}});function ko(x=!1){x?Ps=null:(Ps=g.getBoundingClientRect(),Cn("syncRect",Ps))}function Ed(x,w,I,N,G,J,ce){pe._lock||Es&&x!=null&&x.movementX==0&&x.movementY==0||(Hh(x,w,I,N,G,J,ce,!1,x!=null),x!=null?Ks(null,!0,!0):Ks(w,!0,!1))}function Hh(x,w,I,N,G,J,ce,me,Me){if(Ps==null&&ko(!1),je(x),x!=null)I=x.clientX-Ps.left,N=x.clientY-Ps.top;else{if(I<0||N<0){Vt=-10,$t=-10;return}let[Ue,Fe]=hn.scales,Be=w.cursor.sync,[st,wt]=Be.values,[Mt,gt]=Be.scales,[Ke,Ye]=hn.match,Ht=w.axes[0].side%2==1,Qt=P.ori==0?O:Ie,Rn=P.ori==1?O:Ie,Nt=Ht?J:G,en=Ht?G:J,Qn=Ht?N:I,Vn=Ht?I:N;if(Mt!=null?I=Ke(Ue,Mt)?a(st,S[Ue],Qt,0):-10:I=Qt*(Qn/Nt),gt!=null?N=Ye(Fe,gt)?a(wt,S[Fe],Rn,0):-10:N=Rn*(Vn/en),P.ori==1){let mi=I;I=N,N=mi}}Me&&(w==null||w.cursor.event.type==Pf)&&((I<=1||I>=O-1)&&(I=xr(I,O)),(N<=1||N>=Ie-1)&&(N=xr(N,Ie))),me?(Sd=I,Md=N,[Ur,Fr]=pe.move(n,I,N)):(Vt=I,$t=N)}let Wh={width:0,height:0,left:0,top:0};function Xh(){Ya(Wh,!1)}let Cd,Rd,Pd,Id;function Ld(x,w,I,N,G,J,ce){Es=!0,Tn=En=In._x=In._y=!1,Hh(x,w,I,N,G,J,ce,!0,!1),x!=null&&(St(If,Ff,Dd,!1),Vo(ig,n,Ur,Fr,O,Ie,null));let{left:me,top:Me,width:Ue,height:Fe}=Gt;Cd=me,Rd=Me,Pd=Ue,Id=Fe}function Dd(x,w,I,N,G,J,ce){Es=In._x=In._y=!1,Hh(x,w,I,N,G,J,ce,!1,!0);let{left:me,top:Me,width:Ue,height:Fe}=Gt,Be=Ue>0||Fe>0,st=Cd!=me||Rd!=Me||Pd!=Ue||Id!=Fe;if(Be&&st&&Ya(Gt),In.setScale&&Be&&st){let wt=me,Mt=Ue,gt=Me,Ke=Fe;if(P.ori==1&&(wt=Me,Mt=Fe,gt=me,Ke=Ue),Tn&&Cs(E,Hi(wt,E),Hi(wt+Mt,E)),En)for(let Ye in S){let Ht=S[Ye];Ye!=E&&Ht.from==null&&Ht.min!=Ft&&Cs(Ye,Hi(gt+Ke,Ye),Hi(gt,Ye))}Xh()}else pe.lock&&(pe._lock=!pe._lock,Ks(w,!0,x!=null));x!=null&&(gn(If,Ff),Vo(If,n,Vt,$t,O,Ie,null))}function d_(x,w,I,N,G,J,ce){if(pe._lock)return;je(x);let me=Es;if(Es){let Me=!0,Ue=!0,Fe=10,Be,st;P.ori==0?(Be=Tn,st=En):(Be=En,st=Tn),Be&&st&&(Me=Vt<=Fe||Vt>=O-Fe,Ue=$t<=Fe||$t>=Ie-Fe),Be&&Me&&(Vt=Vt<Ur?0:O),st&&Ue&&($t=$t<Fr?0:Ie),Ks(null,!0,!0),Es=!1}Vt=-10,$t=-10,ne.fill(null),Ks(null,!0,!0),me&&(Es=me)}function Nd(x,w,I,N,G,J,ce){pe._lock||(je(x),Oo(),Xh(),x!=null&&Vo(og,n,Vt,$t,O,Ie,null))}function Ud(){T.forEach(jw),F(n.width,n.height,!0)}Sr(fh,So,Ud);let zr={};zr.mousedown=Ld,zr.mousemove=Ed,zr.mouseup=Dd,zr.dblclick=Nd,zr.setSeries=(x,w,I,N)=>{let G=hn.match[2];I=G(n,w,I),I!=-1&&Gi(I,N,!0,!1)},_e&&(St(ig,g,Ld),St(Pf,g,Ed),St(sg,g,x=>{je(x),ko(!1)}),St(rg,g,d_),St(og,g,Nd),Wf.add(n),n.syncRect=ko);let $a=n.hooks=i.hooks||{};function Cn(x,w,I){kn?Pt.push([x,w,I]):x in $a&&$a[x].forEach(N=>{N.call(null,n,w,I)})}(i.plugins||[]).forEach(x=>{for(let w in x.hooks)$a[w]=($a[w]||[]).concat(x.hooks[w])});let Fd=(x,w,I)=>I,hn=mn({key:null,setSeries:!1,filters:{pub:_g,sub:_g},scales:[E,y[1]?y[1].scale:null],match:[xg,xg,Fd],values:[null,null]},pe.sync);hn.match.length==2&&hn.match.push(Fd),pe.sync=hn;let Od=hn.key,qh=p0(Od);function Vo(x,w,I,N,G,J,ce){hn.filters.pub(x,w,I,N,G,J,ce)&&qh.pub(x,w,I,N,G,J,ce)}qh.sub(n);function p_(x,w,I,N,G,J,ce){hn.filters.sub(x,w,I,N,G,J,ce)&&zr[x](null,w,I,N,G,J,ce)}n.pub=p_;function m_(){qh.unsub(n),Wf.delete(n),An.clear(),zf(fh,So,Ud),c.remove(),Re?.remove(),Cn("destroy")}n.destroy=m_;function Yh(){Cn("init",i,e),Fo(e||i.data,!1),H[E]?zh(E,H[E]):Oo(),oe=Gt.show&&(Gt.width>0||Gt.height>0),ie=ge=!0,F(i.width,i.height)}return y.forEach(Rr),T.forEach(rs),t?t instanceof HTMLElement?(t.appendChild(c),Yh()):t(n,Yh):Yh(),n}Dn.assign=mn;Dn.fmtNum=Kf;Dn.rangeNum=dh;Dn.rangeLog=gh;Dn.rangeAsinh=Zf;Dn.orient=br;Dn.pxRatio=At;Dn.join=Hb;Dn.fmtDate=Qf,Dn.tzDate=ew;Dn.sync=p0;{Dn.addGap=Fw,Dn.clipGaps=vh;let i=Dn.paths={points:y0};i.linear=M0,i.stepped=zw,i.bars=kw,i.spline=Gw}var od=4e3,T0=[.95,.5,.05],Ah=["#0072b2","#d55e00","#009e73","#cc79a7","#8c6d1f","#56b4e9"],bh=[[],[8,3],[3,3],[8,3,2,3],[14,4],[2,5]];function E0(i,e,t){let n=document.createElement("span"),s=document.createElementNS("http://www.w3.org/2000/svg","svg"),r=document.createElementNS("http://www.w3.org/2000/svg","path");for(let[o,a]of Object.entries({d:"M0 5H26",stroke:e,"stroke-dasharray":bh[t%bh.length].join(" ")}))r.setAttribute(o,a);return s.setAttribute("viewBox","0 0 26 10"),s.setAttribute("aria-hidden","true"),s.append(r),n.append(s,i),n}function C0(i,e,t){let n=e.length<=od?e:Array.from({length:od},(o,a)=>e[Math.floor(a*e.length/od)]),s=T0.map(()=>new Array(i).fill(null)),r=new Float64Array(n.length);for(let o=0;o<i;o++){let a=0;for(let c of n){let f=t(o,c);Number.isFinite(f)&&(r[a++]=f)}let l=r.subarray(0,a).sort();T0.forEach((c,f)=>{let u=c*(a-1),h=Math.floor(u);a&&(s[f][o]=l[h]+(u-h)*(l[Math.min(h+1,a-1)]-l[h]))})}return s}function R0(i,e,t,n){let s=new Uint8Array(e);return i.forEach((r,o)=>{if(!(r<t.from||r>t.to)){for(let a=0;a<e;a++)if(!s[a]){let l=n(o,a);s[a]=l>=t.low&&l<=t.high?1:0}}}),s}var wh=class{constructor(e,t,n){Object.assign(this,{element:e,onTime:t,onBox:n,now:0,box:null}),new ResizeObserver(()=>this.fit()).observe(e)}draw({times:e,unit:t,band:n,curves:s,counts:r,style:o,table:a,limits:l}){this.plot?.destroy();let c=_=>_.map(b=>Number.isFinite(b)?b:null),f=[{}],u=[e],h=_=>f.push({points:{show:!1},spanGaps:!1,..._});n&&(u.push(...n),h({width:0}),h({stroke:o.ink,width:2}),h({width:0})),s.forEach(({values:_,colour:b},U)=>{u.push(c(_)),h({stroke:b,width:2,dash:bh[U%bh.length]})}),r.forEach(({values:_,code:b})=>{u.push(_),h({stroke:Ws(b),width:2})});let p=u.slice(1).flat().filter(Number.isFinite),g=p.reduce((_,b)=>Math.min(_,b),1/0),v=p.reduce((_,b)=>Math.max(_,b),-1/0);if(!(v>g)){let _=Number.isFinite(g)?g:0;g=_-(Math.abs(_)*.05||1),v=_+(Math.abs(_)*.05||1)}(r.length||g>0&&g<.5*v)&&(g=0);let d=.04*(v-g),m=jc(t,g,v),y=es("s",e[e.length-1]),T=`12px ${o.font}`,S={stroke:o.soft,font:T,grid:{stroke:o.line,width:1},ticks:{show:!1}};this.plot=new Dn({...this.size(),series:f,legend:{show:!1},padding:[8,12,0,0],bands:n?[{series:[1,3],fill:o.band}]:[],scales:{x:{time:!1},y:{range:[g===0?0:g-d,v+d]}},axes:[{...S,size:26,values:(_,b)=>b.map(U=>tn(U/y.factor,3))},{...S,size:52,values:(_,b)=>b.map(m.text),space:26}],cursor:{x:!0,y:!0,points:{show:!1},drag:{x:!0,y:!0,setScale:!1,dist:6}},hooks:{draw:[_=>{this.drawNow(_,o,a,l)}],setSelect:[_=>this.select(_)]}},u,this.element),this.scale={unit:m.unit,clock:y.unit};let C=this.plot.over,E=0;C.addEventListener("mousedown",_=>{E=_.clientX}),C.addEventListener("click",_=>{Math.abs(_.clientX-E)>5||this.onTime(this.plot.posToVal(_.clientX-C.getBoundingClientRect().left,"x"))}),this.box&&this.showBox()}size(){return{width:Math.max(100,this.element.clientWidth),height:Math.max(60,this.element.clientHeight)}}fit(){this.plot&&this.element.clientWidth&&(this.plot.setSize(this.size()),this.box&&this.showBox())}at(e){this.now=e,this.plot?.redraw(!1)}drawNow(e,t,n,s){let{ctx:r,bbox:o}=e,a=e.valToPos(this.now,"x",!0),l=devicePixelRatio||1;if(r.save(),r.fillStyle=t.mark,r.fillRect(a-l,o.top,2*l,o.height),n)for(let c=0;c<o.height;c++){let f=e.posToVal(o.top+c,"y",!0),u=(f-s[0])/(s[1]-s[0]||1),h=4*Math.round(255*Math.max(0,Math.min(1,u)));r.fillStyle=`rgb(${n[h]} ${n[h+1]} ${n[h+2]})`,r.fillRect(o.left-5*l,o.top+c,4*l,1)}r.restore()}select(e){let{left:t,top:n,width:s,height:r}=e.select;s<2||r<2||(this.box={from:e.posToVal(t,"x"),to:e.posToVal(t+s,"x"),low:e.posToVal(n+r,"y"),high:e.posToVal(n,"y")},this.onBox(this.box))}showBox(){let{from:e,to:t,low:n,high:s}=this.box,r=(o,a)=>this.plot.valToPos(o,a);this.plot.setSelect({left:r(e,"x"),width:r(t,"x")-r(e,"x"),top:r(s,"y"),height:r(n,"y")-r(s,"y")},!1)}};var Qw=`
precision highp float;
in vec2 position;          // 0 to 1 along the segment, −1 to 1 across
in vec4 older, newer;      // place, and time
in vec2 values;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec2 size;
uniform float width, tail, now;
out float across, colourAt, share, distance;
void main() {
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  across = position.y;
  vec4 from = older, to = newer;
  vec2 value = values;
  if (to.w <= tail || from.w >= now) return;
  if (from.w < tail) { float s = (tail - from.w) / (to.w - from.w); from = mix(from, to, s); value.x = mix(value.x, value.y, s); }
  if (to.w > now) to = mix(from, to, (now - from.w) / (to.w - from.w));
  vec4 a = projectionMatrix * modelViewMatrix * vec4(from.xyz, 1.0), b = projectionMatrix * modelViewMatrix * vec4(to.xyz, 1.0);
  // Cut at the plane near the eye.
  float da = a.z + a.w, db = b.z + b.w;
  if (da <= 0.0 && db <= 0.0) return;
  if (da <= 0.0) a = mix(a, b, da / (da - db)); else if (db <= 0.0) b = mix(b, a, db / (db - da));
  vec2 along = (b.xy / b.w - a.xy / a.w) * size;
  along = length(along) > 1e-3 ? normalize(along) : vec2(1.0, 0.0);
  vec4 here = position.x < 0.5 ? a : b;
  distance = here.w;
  float time = position.x < 0.5 ? from.w : to.w;
  share = now > tail ? clamp((time - tail) / (now - tail), 0.0, 1.0) : 1.0;
  colourAt = position.x < 0.5 ? value.x : value.y;
  float wide = width * (0.35 + 0.65 * share);
  gl_Position = here + vec4(vec2(-along.y, along.x) * position.y * wide / size * here.w, 0.0, 0.0);
}`,e1=`
precision highp float;
in float across, colourAt, share, distance;
uniform sampler2D colours;
uniform vec3 unknown;
uniform float opacity, fading;
out vec4 colour;
${mr}
void main() {
  vec3 base = colourAt != colourAt || colourAt < -0.5 ? unknown : texture(colours, vec2((clamp(colourAt, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  float edge = 1.0 - smoothstep(0.55, 1.0, abs(across));
  colour = vec4(hazed(base, distance, 0.3), opacity * edge * mix(1.0, pow(share, 1.5), fading));
}`,Th=10,Ua=class{constructor(e,t,n){this.data=e,this.material=new oi({glslVersion:Mi,vertexShader:Qw,fragmentShader:e1,transparent:!0,depthWrite:!1,uniforms:{size:{value:new xt(1,1)},width:{value:t},tail:{value:-1/0},now:{value:0},opacity:{value:.8},fading:{value:1},colours:{value:null},unknown:{value:new W(.6,.63,.66)},haze:n}}),this.mesh=new vn(new Gs,this.material),this.mesh.frustumCulled=!1,this.mesh.renderOrder=3,this.mesh.visible=!1,this.numbers=new Float32Array(0),this.recorded=new Map,e.paths?.bodies.forEach((s,r)=>this.recorded.set(s,[...this.recorded.get(s)??[],r]))}draw(e,t,n,s,r){let{data:o}=this,{n:a,x:l,times:c,paths:f}=o,u=Math.max(0,Fa(c,t)),h=Fa(c,n*(1+1e-9)),p=0,g=(v,d,m,y,T,S,C,E)=>{if(v[3*d]===T[3*S]&&v[3*d+1]===T[3*S+1]&&v[3*d+2]===T[3*S+2])return;if(Th*(p+1)>this.numbers.length){let U=new Float32Array(Math.max(4096,2*this.numbers.length));U.set(this.numbers),this.numbers=U}let _=Th*p++,{numbers:b}=this;for(let U=0;U<3;U++)b[_+U]=v[3*d+U],b[_+4+U]=T[3*S+U];b[_+3]=m,b[_+7]=C,b[_+8]=y,b[_+9]=E};for(let v of e){let d=this.recorded.get(v);for(let m of d??[])for(let y=f.start[m]+1;y<f.start[m+1];y++){if(f.times[y]<=t||f.times[y-1]>=n)continue;let[T,S]=[y-1,y].map(C=>s(t1(c,f.times[C]),v));g(f.points,y-1,f.times[y-1],T,f.points,y,f.times[y],S)}for(let m=d?h+1:u+1;m<=h;m++)!o.present(m-1,v)||o.jumps(m,v)||g(l,a*(m-1)+v,c[m-1],s(m-1,v),l,a*m+v,c[m],s(m,v))}this.replace(p),Object.assign(this.material.uniforms.tail,{value:t}),Object.assign(this.material.uniforms.now,{value:n}),Object.assign(this.material.uniforms.fading,{value:r?1:0})}replace(e){let t=new Gs;t.setAttribute("position",new Xt(new Float32Array([0,-1,1,-1,1,1,0,1]),2)),t.setIndex([0,1,2,0,2,3]);let n=new ha(this.numbers.slice(0,Th*e),Th);t.setAttribute("older",new rr(n,4,0)),t.setAttribute("newer",new rr(n,4,4)),t.setAttribute("values",new rr(n,2,8)),t.instanceCount=e,t.boundingSphere=new vi(new W,1),this.mesh.geometry.dispose(),this.mesh.geometry=t,this.mesh.visible=e>0}};function Fa(i,e){let t=0,n=i.length;for(;t<n;){let s=t+n>>1;i[s]<=e?t=s+1:n=s}return t-1}function t1(i,e){let t=Math.max(0,Fa(i,e));return t+1<i.length&&i[t+1]-e<e-i[t]?t+1:t}var te=i=>document.getElementById(i),Ro=new URLSearchParams(window.name.startsWith("foamprb ")?window.name.slice(8):location.hash.slice(1)),n1=4,i1=4e5,s1=8,P0=[.1,.2,.5,1,2,5,10],N0=[["Space","play, stop",()=>Do(!re.playing)],[", and .","previous, next time",null],["Home, End","first, last time",null],["Arrows","turn; with shift move",null],["+ and −","zoom",null],["N and P","select the next, the previous body",null],["F","follow the selected body",()=>xd(!re.follow)],["Escape","deselect the body",()=>Er(-1)],["0","first view",()=>He.goHome()],["W","whole geometry",()=>He.showAll(J0())],["M","mark on the surface",()=>w1("mark")],["S","save the picture",()=>n_()],["D","light or dark",()=>Lh(Va()?"light":"dark")],["T","values over time",()=>Ba(te("plot").hidden)],["O","options",()=>Nh(!te("panel").classList.contains("open"))],["H","this list",()=>te("about").showModal()]],j,Bn,He,wn,Io,zt,Eh,Lo,Oa,$s,Ar,U0,F0,ad=new sr,Ys={value:new Lt(1,1,1,1)},re={t:0,chosen:-1,follow:!1,playing:!1,speed:10,name:"",part:"",low:0,high:1,map:"",enlargement:1,fates:new Set,injectors:new Set,gone:!1,curve:null,count:0,kept:[],boxed:null},pi={},Jn=!1,cd=!1,Zs={};async function r1(){if(!document.createElement("canvas").getContext("webgl2"))throw new Error("it needs WebGL 2, which this browser or computer does not provide");if(typeof DecompressionStream>"u")throw new Error("it needs a browser of 2023 or newer");for(let t of["bare","naked"])document.documentElement.classList.toggle(t,Ro.has(t));Ro.has("naked")&&document.documentElement.classList.add("bare"),j=await Xm();let{scene:i}=j,e=te("canvas");mt.enabled=!1,Bn=new qc({canvas:e,antialias:!0,alpha:!1,stencil:!0,preserveDrawingBuffer:!1}),Bn.outputColorSpace=ir,wn=new go(j,Ys),Io=new nh(j,Ys),$s=new ih,Lo=new Ua(j,3,Ys),Oa=new Ua(j,4,Ys),ad.add(wn.mesh,Io.group,Lo.mesh,Oa.mesh,$s.points),j.flow&&ad.add((zt=new sh(j,Io)).group,Eh=qm(j.flow,Ys)),He=new Jc(e,i.home,B0(),()=>{Jn=!0},S1);for(let[t,n]of Object.entries({...i.maps,...i.planeMaps}))Zs[t]={bytes:Bm(n),texture:null};U0=new oh(j),Ar=new wh(te("curves"),t=>{Do(!1),Kn(V0(t))},pd),d1(i),m1(i),T1(),re.enlargement=i.enlargement,re.t=Math.min(j.m-1,i.first),Lh(Ro.get("theme")??"auto"),_d(i.enlargement),Oh(...i.colour,i.range),gd(),te("app").classList.remove("loading"),te("notice").textContent="",innerWidth>=1100&&innerHeight>=820&&j.m>2&&Ba(!0),Ph(),He.goHome(),new ResizeObserver(Ph).observe(te("stage")),F0=new ah(Ro,o1,I0),I0(Ro),Kn(re.t),requestAnimationFrame(is)}function o1(){let{yaw:i,pitch:e,distance:t,fit:n,target:s}=He,r={t:[j.times[re.t]],colour:`${re.name}:${re.part}`,eye:[i,e,t/n,s.x,s.y,s.z]};return re.chosen<0?r:{...r,body:[j.ids[re.chosen]]}}function I0(i){let e=a=>(i.get(a)??"").split(",").filter(Boolean).map(Number),[t,n]=(i.get("colour")??"").split(":"),[s]=e("t"),[r]=e("body"),o=e("eye");n!==void 0&&[...te("colour").options].some(({value:a})=>a===`${t}:${n}`)&&Oh(t,n),Number.isFinite(s)&&Kn(V0(s)),j.ids.includes(r)&&Er(j.ids.indexOf(r)),o.length===6&&o.every(Number.isFinite)&&He.look(...o)}function is(i){if(re.playing){let{times:e,m:t}=j,n=(e[t-1]-e[0])/(t-1);is.clock+=(i-(is.last??i))/1e3*re.speed,is.last=i,is.clock>e[t-1]+n&&(is.clock=e[0]);let s=Math.max(0,Fa(e,is.clock));s!==re.t&&Kn(s)}Jn&&Rh(),requestAnimationFrame(is)}function Rh(){Jn=!1;for(let{material:e}of[Lo,Oa])e.uniforms.size.value.set(He.width,He.height);let i=2*Math.tan(j.scene.home.angle*Math.PI/360);wn.material.uniforms.pixel.value=i/He.height,cd&&h1(),te("card").hidden||a1(),Ys.value.w=He.distance,zt?.face(He.camera.position),Bn.render(ad,He.camera),f1(),_1(),l1(),F0?.changed()}function a1(){let i=re.chosen,e=[...j.times.keys()].filter(r=>dd(r,i)),t=Math.min(_r,e.length),n=Array.from({length:t},(r,o)=>e[Math.round(o*(e.length-1)/Math.max(1,t-1))]);if(te("gallery").hidden=t===0,t===0)return;let s={...Fh(),raised:new ht().setRGB(...Kc(Tr("--raised")).map(r=>r/255))};te("gallery").setAttribute("aria-label",U0.paint(te("gallery"),Bn,i,n,re.t,ud(),He.axes(),wn.material,s))}function l1(){let i=te("compass"),e=Bn.getPixelRatio(),{scene:t}=j,[n,s]=[th(t),yf].map(a=>Math.round(a*e));i.width!==n&&Object.assign(i,{width:n,height:s});let r=i.getContext("2d");r.clearRect(0,0,n,s);let o=Sf(r,0,0,He.axes(),O0(),t,Fh(),e);i.setAttribute("aria-label",`Axes, ${Object.keys(t.directions).map(a=>`direction of ${a}, `).join("")}scale bar of ${o}`)}var O0=()=>wn.material.uniforms.pixel.value*He.distance*j.scene.frame.size,Fh=()=>({font:getComputedStyle(document.body).fontFamily,ink:Tr("--ink"),soft:Tr("--soft"),accent:Tr("--accent")});function Ph(){let{clientWidth:i,clientHeight:e}=te("stage");!i||!e||(Bn.setPixelRatio(Math.min(window.devicePixelRatio||1,2.5)),Bn.setSize(i,e,!1),$s.points.material.uniforms.ratio.value=Bn.getPixelRatio(),He.insets=B0(),He.resize(i,e),Jn=!0)}function B0(){if(Ro.has("naked"))return[0,0];let[i,e]=j.scene.home.insets,t=te("card"),n=!t.hidden&&getComputedStyle(t).position==="fixed";return[i,n?t.offsetHeight-te("transport").offsetHeight:Math.max(e,te("bottom").offsetHeight+12)]}var hd=i=>i==="active"||i==="stuck";function Ih(i,e=re.t){let{fate:t,injector:n}=j.codes,{filter:s,boxed:r}=re;if(re.fates.has(t.code(0,i))||r&&!r[i]||n&&re.injectors.has(n.code(e,i)))return!1;if(s&&s.field){let o=s.field.value(e,i,s.part);if(!(o>=s.low&&o<=s.high))return!1}return!0}function c1(i){return j.present(re.t,i)?(re.gone||hd(j.codes.status.meaning(re.t,i)))&&Ih(i):!1}function ud(){let i=j.codes[re.name],e=j.fields[re.name],{part:t,low:n}=re,s=re.high-n||1;return i?(r,o)=>i.code(r,o)/255:(r,o)=>{let a=e.value(r,o,t);return Number.isFinite(a)?Math.max(0,Math.min(1,(a-n)/s)):-1}}function Kn(i){let e=re.t;re.t=i;let t=ud();if(re.count=wn.show(i,c1,s=>t(i,s)),wn.material.uniforms.chosen.value=re.chosen,k0(),re.follow&&re.chosen>=0){let s=3*(j.n*e+re.chosen),r=3*(j.n*i+re.chosen),{x:o}=j;He.target.add(new W(o[r]-o[s],o[r+1]-o[s+1],o[r+2]-o[s+2])),He.place()}z0(),Ar.at(j.times[i]),te("time").value=i;let n=hi(j.times[i],"s",j.times[j.m-1]);te("time").setAttribute("aria-valuetext",n),te("time-text").textContent=n,te("clock").textContent=`t = ${n}`,te("caption").textContent=fd(),re.chosen>=0&&Q0(),Jn=!0}function fd(){let i=re.enlargement===1?"drawn to scale":`drawn ${tn(re.enlargement,3)}× larger`;return`${re.count} ${re.count===1?"body":"bodies"}, ${i}`}function z0(){let i=[],{n:e,x:t}=j,{status:n}=j.codes,{t:s}=re;if(te("deposits").value==="marked")for(let r=0;r<e;r++){let o=3*(e*s+r);wn.shown[r]&&n.meaning(s,r)==="stuck"&&i.push(t[o],t[o+1],t[o+2])}$s.draw(i)}function k0(){let i=ud(),e=te("trails").value,{t,chosen:n}=re,s=j.times[t],r=[];if(e==="fading"||e==="whole")for(let c=0;c<j.n;c++)j.present(t,c)&&Ih(c)&&r.push(c);let o=e==="fading"?j.scene.mostTrails:Math.max(1,Math.floor(i1/j.m));r.length>o&&(Cr(`${o} of ${r.length} bodies have trails.`),r=Array.from({length:o},(c,f)=>r[Math.floor(f*r.length/o)]));let a=e==="fading",l=j.times[0]-1;Lo.draw(r,a?s-j.scene.trail:l,s,i,a),Lo.material.uniforms.opacity.value=a?.85:Math.max(.18,Math.min(.6,60/r.length)),Oa.draw(e!=="none"&&n>=0?[n]:[],l,s,i,!1),Jn=!0}var V0=i=>j.times.reduce((e,t,n)=>Math.abs(t-i)<Math.abs(j.times[e]-i)?n:e,0);function ss(){cd=Jn=!0}function Ba(i){te("plot").hidden=!i,te("open-plot").setAttribute("aria-expanded",String(i)),document.documentElement.classList.toggle("plotted",i),ss()}var dd=(i,e)=>j.present(i,e)&&hd(j.codes.status.meaning(i,e)),G0=(i,e)=>dd(i,e)?j.fields[re.name].value(i,e,re.part):NaN;function h1(){if(cd=!1,te("plot").hidden)return;let i=j.fields[re.name],e=j.codes[re.name],t=Array.from({length:j.n},(u,h)=>h),n=re.chosen>=0&&!re.kept.includes(re.chosen)?[...re.kept,re.chosen]:re.kept,s=i?n.map((u,h)=>({values:vd(i,re.part,u),colour:Ah[h],text:`${j.ids[u]}`})):[],r=i?[]:pi.colour.names.map(([u,h])=>({code:u,text:h,values:j.times.map(()=>0)}));for(let{code:u,values:h}of r)h.forEach((p,g)=>{for(let v=0;v<j.n;v++)e.code(g,v)===u&&dd(g,v)&&Ih(v,g)&&h[g]++});let o=i?C0(j.m,t,(u,h)=>Ih(h,u)?G0(u,h):NaN):null,a={...Fh(),line:Tr("--line"),mark:Tr("--deposit"),band:Va()?"rgb(173 185 197 / 28%)":"rgb(76 89 102 / 20%)"};Ar.draw({times:j.times,unit:i?.unit??"",band:o,curves:s,counts:r,style:a,table:i&&Zs[re.map]?.bytes,limits:[re.low,re.high]});let{unit:l,clock:c}=Ar.scale,f=i?Ha(za(i,re.part)):"Bodies in the flow or on walls";te("plot-title").textContent=`${f}${l?` (${l})`:""} over time (${c})`,te("plot-words").textContent=i?"Median and 5–95 % of the shown bodies":"",te("plot-keys").replaceChildren(...[...s.map(({text:u},h)=>[u,Ah[h],h]),...r.map(({code:u,text:h})=>[h,Ws(u),0])].map(([u,h,p])=>E0(u,h,p))),Ar.at(j.times[re.t])}function pd(i){Ar.box=i;let e=j.fields[re.name],t=j.codes[re.name];re.boxed=i&&e&&!t?R0(j.times,j.n,i,G0):null;let n=re.boxed?.reduce((s,r)=>s+r,0);te("plot-clear").hidden=!re.boxed,te("plot-clear").textContent=`${n} ${n===1?"body passes":"bodies pass"} through the box. Show all`,re.boxed&&Cr(te("plot-clear").textContent),ss(),Kn(re.t)}function u1(i){re.kept=re.kept.filter(e=>e!==re.chosen),i&&(re.kept=[...re.kept,re.chosen].slice(-Ah.length+1)),i&&Ba(!0),ss()}function f1(){let i=[],e=new W,t=[...te("stage").querySelectorAll("#heading, #facts, .legend, #compass")].map(ld);for(let n of te("labels").children){let s=Io.patches[n.dataset.patch],r=j.surfaces[n.dataset.patch].anchor;if(n.hidden=!0,!te("names").checked||!s.visible||(e.set(...r).project(He.camera),Math.abs(e.x)>1||Math.abs(e.y)>1||e.z>1))continue;n.hidden=!1;let o=n.offsetWidth,a=n.offsetHeight,l=Math.max(4,Math.min(He.width-o-4,(.5+.5*e.x)*He.width-o/2)),c=Math.max(4,Math.min(He.height-a-4,(.5-.5*e.y)*He.height-a-6)),f={left:l,top:c,right:l+o,bottom:c+a};if([...i,...t].some(u=>u.left<f.right&&f.left<u.right&&u.top<f.bottom&&f.top<u.bottom)){n.hidden=!0;continue}i.push(f),n.style.transform=`translate(${l.toFixed(1)}px, ${c.toFixed(1)}px)`}}function ld(i){let e=i.getBoundingClientRect(),t=te("stage").getBoundingClientRect();return{left:e.left-t.left,top:e.top-t.top,right:e.right-t.left,bottom:e.bottom-t.top}}function d1(i){document.title=`${i.title} – ${i.subtitle}`,te("title").textContent=i.title,te("subtitle").textContent=i.subtitle,te("groups").textContent=i.groups,te("made").textContent=i.made,te("compass").style.width=`${th(i)}px`,te("compass").style.height=`${yf}px`,te("notes").textContent=i.notes.join(" ");for(let[e,t]of N0){let n=document.createElement("dt"),s=document.createElement("dd");n.textContent=e,s.textContent=t,te("keys").append(n,s)}}function ws(i,e,t){let n=document.createElement("option");n.value=e,n.textContent=t,i.append(n)}var p1={magnitude:"magnitude",x:"x",y:"y",z:"z"},za=(i,e)=>e?`${i.label}, ${p1[e]??e}`:i.label;function m1(i){for(let s of[te("colour"),te("filter")]){s===te("filter")&&ws(s,"","all values");for(let r of Object.values(j.fields))for(let o of r.parts)ws(s,`${r.name}:${o}`,za(r,o));if(s===te("colour"))for(let r of Object.values(j.codes))ws(s,`${r.name}:`,r.label)}for(let s of Object.keys(i.maps))ws(te("map"),s,s);let e=P0.map(s=>Ta(s*(j.times[j.m-1]-j.times[0]||1)/s1));for(let s of new Set(e))ws(te("speed"),s,s<1?`1/${tn(1/s,2)}×`:`${tn(s,2)}×`);re.speed=e[P0.indexOf(1)],te("speed").value=re.speed,te("time").max=j.m-1;let{fate:t,injector:n}=j.codes;L0(te("fates"),t,s=>t.code(0,s),re.fates),n&&L0(te("injectors"),n,s=>n.code(j.m-1,s),re.injectors),te("injectors").hidden=!n||n.meanings.length<2,te("deposits-row").hidden=!t.meanings.some(s=>s.startsWith("stuck")),te("trails").value=j.m>1&&i.trail>0&&j.n<=i.mostTrails?"fading":"none",j.scene.deposits&&ws(te("deposits"),"dense","per area of walls"),te("deposits").value="marked",te("walls").hidden=j.surfaces.length===0,Io.patches.forEach((s,r)=>{let o=H0(`${s.name}`,s.visible,c=>{s.visible=c,Ga()}),a=document.createElement("span");a.className="count",a.textContent=s.type,o.append(a),te("patches").append(o);let l=document.createElement("span");l.textContent=s.name,l.dataset.patch=r,te("labels").append(l)}),te("flow").hidden=!j.flow,j.flow&&g1()}function H0(i,e,t){let n=document.createElement("label"),s=document.createElement("input");return n.className="check",s.type="checkbox",s.checked=e,s.addEventListener("change",()=>t(s.checked)),n.append(s,i),n}function L0(i,e,t,n){let s=new Map;for(let o=0;o<j.n;o++)s.set(t(o),(s.get(t(o))??0)+1);let r=i.querySelector(".choices");for(let[o,a]of[...s].sort((l,c)=>l[0]-c[0])){let l=H0(e.meanings[o]??"none",!0,f=>{n[f?"delete":"add"](o),ss(),Kn(re.t)}),c=document.createElement("span");c.className="count",c.textContent=a,l.append(c),r.append(l)}}function Oh(i,e,t=null){Object.assign(re,{name:i,part:e}),re.boxed&&pd(null),ss(),te("colour").value=`${i}:${e}`;let n=j.codes[i];for(let s of["range-row","range-buttons","map-row"])te(s).hidden=!!n;if(n){X0({bytes:zm(n.meanings.length),texture:null},!0);let s=new Uint8Array(256);for(let r of n.whole)s[r]=1;pi.colour={label:Ha(n.label),names:n.meanings.map((r,o)=>[o,r]).filter(([r,o])=>s[r]&&o)},Wa()}else{Ch(...t??j.fields[i].ranges[e].usual,!1);let s=re.low===-re.high;W0(s&&j.scene.maps.coolwarm?"coolwarm":"viridis")}Kn(re.t)}function Ch(i,e,t=!0){if(!(e>i))return;Object.assign(re,{low:i,high:e}),te("range-low").value=tn(i).replace("−","-").replace(/ × 10(.*)/,(a,l)=>`e${D0(l)}`),te("range-high").value=tn(e).replace("−","-").replace(/ × 10(.*)/,(a,l)=>`e${D0(l)}`);let n=j.fields[re.name],s=n.unit?` (${_o(n.unit)})`:"";te("range-word").textContent=`Range${s}`;let[r,o]=n.ranges[re.part].extremes;pi.colour={label:Ha(za(n,re.part)),unit:n.unit,low:i,high:e,least:r,most:o,table:Zs[re.map]?.bytes},ss(),t&&(Wa(),Kn(re.t))}var D0=i=>[...i].map(e=>({"⁻":"-"})[e]??"⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(e)).join(""),Ha=i=>i.charAt(0).toUpperCase()+i.slice(1);function W0(i){re.map=i,te("map").value=i,X0(Zs[i],!1),ss(),pi.colour&&!pi.colour.names&&(pi.colour.table=Zs[i].bytes),Wa()}function X0(i,e){for(let{material:t}of[wn,Lo,Oa])t.uniforms.colours.value=md(i,e);Jn=!0}function md(i,e){return i.texture||(i.texture=new oo(i.bytes,256,1,ci),i.texture.magFilter=i.texture.minFilter=e?fn:dn,i.texture.needsUpdate=!0),i.texture}var wr=[];function g1(){let{plane:i,values:e}=j.flow;ws(te("slice"),"none","none"),e.forEach((r,o)=>ws(te("slice"),o,r.label)),wr=[["x",[1,0,0]],["y",[0,1,0]],["z",[0,0,1]]];let t=i&&wr.findIndex(([,r])=>r.every((o,a)=>Math.abs(Math.abs(o)-Math.abs(i[1][a]))<1e-9));t===-1&&wr.push([j.flow.plane[1].map(r=>tn(r,2)).join(", "),i[1]]),wr.forEach(([r],o)=>ws(te("normal"),o,r));let n=zt.high.clone().sub(zt.low).toArray(),s=n.indexOf(Math.min(...n));te("normal").value=i?(t+wr.length)%wr.length:s,te("slice").value=i?"0":"none",q0(),i&&ka(new W(...i[0]).dot(zt.normal))}function q0(){let i=new W(...wr[Number(te("normal").value)][1]),[e,t]=zt.range(i);zt.place(i,.5*(e+t)),ka(.5*(e+t))}function ka(i){let[e,t]=zt.range(zt.normal),{middle:n,size:s}=j.scene.frame;zt.place(zt.normal,Math.max(e,Math.min(t,i))),te("offset").value=(zt.offset-e)/(t-e||1);let r=hi(zt.normal.dot(new W(...n))+s*zt.offset,"m",s);te("offset").setAttribute("aria-valuetext",r),te("offset-text").textContent=r,Jn=!0}function Y0(){let[i,e]=[0,.001].map(t=>zt.centre.clone().addScaledVector(zt.normal,t).project(He.camera));return[(e.x-i.x)*500*He.width,(i.y-e.y)*500*He.height]}function _1(){let i=zt?.group.visible,e=te("handle");if(e.hidden=!i,!i)return;let{x:t,y:n}=zt.centre.clone().project(He.camera),[s,r]=Y0(),[o,a]=[(.5+.5*t)*He.width,(.5-.5*n)*He.height];e.hidden=!(o>0&&o<He.width&&a>0&&a<He.height);let l=Math.hypot(s,r)<1?0:Math.atan2(s,-r);e.style.transform=`translate(${o.toFixed(1)}px, ${a.toFixed(1)}px) rotate(${l.toFixed(3)}rad)`}function x1(){let i=te("handle"),e=null;i.addEventListener("pointerdown",t=>{i.setPointerCapture(t.pointerId),e=t}),i.addEventListener("pointermove",t=>{if(!e)return;let[n,s]=Y0(),[r,o]=[t.clientX-e.clientX,t.clientY-e.clientY],a=He.height/He.distance,l=n*n+s*s;ka(zt.offset+(l>(.1*a)**2?(r*n+o*s)/l:-o/a)),e=t});for(let t of["pointerup","pointercancel"])i.addEventListener(t,()=>{e=null});i.addEventListener("keydown",t=>{let n={ArrowUp:1,ArrowRight:1,ArrowDown:-1,ArrowLeft:-1}[t.key];if(!n)return;let[s,r]=zt.range(zt.normal);ka(zt.offset+.02*n*(r-s)),t.preventDefault()})}function gd(){if(!zt)return;let i=te("slice").value,e=j.flow.values[i],t=Zs[Va()?"dark":"light"];zt.show(i,md(t,!1)),te("plane-place").hidden=!e,e?pi.plane={label:Ha(e.label),unit:e.unit,low:e.range[0],high:e.range[1],least:e.extremes[0],most:e.extremes[1],table:t.bytes}:delete pi.plane,Wa(),Jn=!0}var $0=()=>[pi.plane,pi.deposits,pi.colour].filter(i=>i?.names||i?.table);function Wa(){te("legends").replaceChildren();for(let i of $0())jm(te("legends"),i);He.width&&Ph()}function _d(i){re.enlargement=i,wn.material.uniforms.enlargement.value=i;let e=Math.log10(Math.max(10,10*j.scene.enlargement));te("enlargement").value=Math.log10(i)/e;let t=i===1?"to scale":`${tn(i,3)}×`;te("enlargement-text").textContent=t,te("enlargement").setAttribute("aria-valuetext",i===1?"to scale":`${tn(i,3)} times`),te("caption").textContent=fd(),Jn=!0}var Va=()=>document.documentElement.dataset.theme==="dark";function Lh(i){te("theme").value=i;let e=matchMedia("(prefers-color-scheme: dark)").matches;document.documentElement.dataset.theme=i==="auto"?e?"dark":"light":i,Ga(),gd(),ss()}function Tr(i){return getComputedStyle(document.documentElement).getPropertyValue(i).trim()}var Z0=()=>te("deposits").value==="dense";function v1(){Z0()?pi.deposits={label:"Deposits per area",low:0,...j.scene.deposits,table:Zs.magma.bytes}:delete pi.deposits,z0(),Wa(),Ga()}function Ga(){let i=t=>Kc(Tr(t)).map(n=>n/255),e=i("--paper");Bn.setClearColor(new ht().setRGB(...e),1),Io.paint({glass:i("--glass"),glassDeep:i("--glass-deep"),edge:i("--edge"),accent:i("--accent")},te("opacity").value,Va(),Z0()?md(Zs.magma,!1):null),wn.material.uniforms.darkness.value=Va()?1:0,wn.material.uniforms.accent.value.set(...i("--accent")),Eh&&(Eh.visible=te("streams").checked,Eh.material.uniforms.base.value.set(...i("--soft"))),$s.points.material.uniforms.base.value.set(...i("--deposit")),$s.points.material.uniforms.paper.value.set(...e),Ys.value.set(...e,Ys.value.w),Jn=!0}function Do(i){re.playing=i&&j.m>1,is.last=void 0,is.clock=j.times[re.t],document.documentElement.classList.toggle("playing",re.playing),te("play-word").textContent=re.playing?"Stop":"Play",te("play").title=re.playing?"Stop (space)":"Play (space)"}function Po(i){Do(!1),Kn(Math.max(0,Math.min(j.m-1,re.t+i))),Cr(te("time-text").textContent)}function J0(){return j.scene.frame.halves}function y1(i,e){let t=new ua;return t.setFromCamera(new xt(2*i/He.width-1,1-2*e/He.height),He.camera),t.ray}function K0(i,e){let{origin:t,direction:n}=y1(i,e);return wn.pick(re.t,t,n,wn.material.uniforms.pixel.value)}function S1({x:i,y:e}){Er(K0(i,e))}function Er(i){re.chosen=i,ss(),te("keep").checked=re.kept.includes(i),i<0&&xd(!1),te("card").hidden=i<0,i>=0&&(Nh(!1),Cr(`Body ${j.ids[i]} is selected.`)),Kn(re.t),Ph(),i>=0&&M1(i)}function M1(i){let{x:e,y:t,z:n}=j0(i),[s,r]=He.insets;if(n<1&&e>0&&e<He.width&&t>s&&t<He.height-r||!j.present(re.t,i))return;let o=3*(j.n*re.t+i);He.target.set(j.x[o],j.x[o+1],j.x[o+2]),He.place()}function j0(i){let e=3*(j.n*re.t+i),t=new W(j.x[e],j.x[e+1],j.x[e+2]).project(He.camera);return{x:(.5+.5*t.x)*He.width,y:(.5-.5*t.y)*He.height,z:t.z}}function Dh(i){let e=[...wn.shown.keys()].filter(n=>wn.shown[n]);if(e.length===0)return;let t=e.indexOf(re.chosen);Er(e[t<0?i>0?0:e.length-1:(t+i+e.length)%e.length])}function xd(i){if(re.follow=i&&re.chosen>=0,te("follow").checked=re.follow,!re.follow)return;let e=3*(j.n*re.t+re.chosen);He.target.set(j.x[e],j.x[e+1],j.x[e+2]),He.distance=Math.min(He.distance,Math.max(He.fit/3,30*j.radius[re.chosen]*re.enlargement)),He.place()}function vd(i,e,t){let{status:n}=j.codes;return j.times.map((s,r)=>j.present(r,t)&&hd(n.meaning(r,t))?i.value(r,t,e):NaN)}function Q0(){let i=re.chosen,{t:e}=re,{fate:t,injector:n}=j.codes;te("card-title").textContent=`Body ${j.ids[i]}`;let{t0:s,t1:r}=j.fields,o=[];n&&o.push(`from ${n.meaning(j.m-1,i)}`),s&&o.push(`released at ${hi(s.value(0,i,""),"s",j.times[j.m-1])}`),o.push(r?`${t.meaning(0,i)} at ${hi(r.value(0,i,""),"s",j.times[j.m-1])}`:t.meaning(0,i)),te("card-story").textContent=Ha(o.join(", "));let[a]=Object.values(j.fields),l=re.curve??(j.fields[re.name]?{name:re.name,part:re.part}:{name:a.name,part:a.parts[0]}),c=[];if(!j.present(e,i))c.push(["","not released yet",null]);else{let p=3*(j.n*e+i),{middle:g,size:v}=j.scene.frame,d=[0,1,2].map(T=>g[T]+v*j.x[p+T]),{factor:m,unit:y}=es("m",v);c.push([`position (${y})`,d.map(T=>tn((Math.abs(T)<1e-6*v?0:T)/m,4)).join(", "),null]);for(let T of Object.values(j.fields))if(!(T.name==="t0"||T.name==="t1"))for(let S of T.parts)c.push([za(T,S),hi(T.value(e,i,S),T.unit),{name:T.name,part:S}])}let f=te("card-rows"),u=f.contains(document.activeElement)?document.activeElement.dataset.key:null;f.replaceChildren();for(let[p,g,v]of c){let d=document.createElement("button");d.type="button";let m=document.createElement("span"),y=document.createElement("span");m.textContent=p,y.textContent=g,d.append(m,y),d.disabled=!v,v&&(d.dataset.key=`${v.name}:${v.part}`,d.title="Plot over time",d.setAttribute("aria-pressed",String(v.name===l.name&&v.part===l.part)),d.addEventListener("click",()=>{re.curve=v,Q0()})),f.append(d),u&&d.dataset.key===u&&d.focus()}let h=j.fields[l.name];h&&Gm(te("chart"),{label:za(h,l.part),unit:h.unit,times:j.times,values:vd(h,l.part,i),now:e})}function b1(){let i=re.chosen,{middle:e,size:t}=j.scene.frame,n=[["t [s]",j.times,7]];for(let o=0;o<3;o++)n.push([`${"xyz"[o]} [m]`,j.times.map((a,l)=>e[o]+t*j.x[3*(j.n*l+i)+o]),7]);for(let o of Object.values(j.fields))for(let a of o.parts)n.push([`${o.name}${a?`_${a}`:""}${o.unit?` [${o.unit}]`:""}`,vd(o,a,i),n1]);let s=j.times.map((o,a)=>j.present(a,i)?n.map(([,l,c])=>Number(l[a].toPrecision(c))).join(","):null),r=[n.map(([o])=>o).join(","),...s.filter(Boolean)].join(`
`);e_(new Blob([`${r}
`],{type:"text/csv"}),`${j.scene.title}_body_${j.ids[i]}.csv`)}function e_(i,e){let t=document.createElement("a");t.href=URL.createObjectURL(i),t.download=e.replace(/[^\w.-]+/g,"_"),t.click(),setTimeout(()=>URL.revokeObjectURL(t.href),1e4)}async function t_(){let{width:i,height:e}=He,t=Bn.getPixelRatio(),n=2;Bn.setPixelRatio(n),Bn.setSize(i,e,!1),$s.points.material.uniforms.ratio.value=n,Rh();let s=new OffscreenCanvas(i*n,e*n),r=s.getContext("2d");r.drawImage(Bn.domElement,0,0),Bn.setPixelRatio(t),Bn.setSize(i,e,!1),$s.points.material.uniforms.ratio.value=t,Rh();let o=Fh(),a=(c,f,u,h,p,g)=>{r.font=h,r.fillStyle=p,r.textAlign=g,r.fillText(c,f,u)};a(j.scene.title,22*n,32*n,`600 ${17*n}px ${o.font}`,o.ink,"left"),a([j.scene.subtitle,j.scene.groups].filter(Boolean).join("  ·  "),22*n,53*n,`${14*n}px ${o.font}`,o.soft,"left"),a(te("clock").textContent,(i-22)*n,32*n,`600 ${17*n}px ${o.font}`,o.ink,"right"),a(fd(),(i-22)*n,53*n,`${14*n}px ${o.font}`,o.soft,"right"),r.textAlign="center";for(let c of te("labels").children){if(c.hidden)continue;let f=ld(c);a(c.textContent,(f.left+f.right)/2*n,(f.bottom-5)*n,`${12*n}px ${o.font}`,o.soft,"center")}r.textAlign="left",Qm(r,$0().reverse(),o,n,e*n);let l=ld(te("compass"));return Sf(r,l.left*n,l.top*n,He.axes(),O0(),j.scene,o,n),s}async function n_(){let i=await t_();e_(await i.convertToBlob({type:"image/png"}),`${j.scene.title}_t${tn(j.times[re.t])}.png`),Cr("The picture is saved.")}function Cr(i){te("status").textContent=i}function Nh(i){te("panel").classList.toggle("open",i),te("open-panel").setAttribute("aria-expanded",String(i)),i&&getComputedStyle(te("corner")).display!=="none"&&te("close-panel").focus()}function w1(i){te(i).checked=!te(i).checked,te(i).dispatchEvent(new Event("change"))}function Uh(i,e){let t=te(i).value.trim().replace(",",".").replace("−","-"),n=t===""?e:Number(t),s=Number.isNaN(n);return te(i).setAttribute("aria-invalid",String(s)),s&&Cr("Not a number."),s?e:n}function A1(){let[i,e]=te("filter").value.split(":");re.filter=i?{field:j.fields[i],part:e,low:Uh("filter-low",-1/0),high:Uh("filter-high",1/0)}:null,ss(),Kn(re.t)}function T1(){let i=(t,n,s)=>te(t).addEventListener(n,s);i("time","input",()=>{Do(!1),Kn(Number(te("time").value))}),i("play","click",()=>Do(!re.playing)),i("backward","click",()=>Po(-1)),i("forward","click",()=>Po(1)),i("speed","change",()=>{re.speed=Number(te("speed").value)}),i("colour","change",()=>Oh(...te("colour").value.split(":")));for(let t of["range-low","range-high"])i(t,"change",()=>Ch(Uh("range-low",re.low),Uh("range-high",re.high)));i("range-all","click",()=>Ch(...j.fields[re.name].ranges[re.part].whole)),i("range-now","click",()=>{let t=1/0,n=-1/0;for(let s=0;s<j.n;s++){let r=wn.shown[s]?j.fields[re.name].value(re.t,s,re.part):NaN;r<t&&(t=r),r>n&&(n=r)}Ch(t,n)}),i("map","change",()=>W0(te("map").value)),i("enlargement","input",()=>{let n=10**(Math.log10(Math.max(10,10*j.scene.enlargement))*Number(te("enlargement").value));_d(n<1.02?1:Number(n.toPrecision(2)))}),i("mark","change",()=>{wn.material.uniforms.mark.value=te("mark").checked?1:0,Jn=!0}),i("trails","change",k0),i("deposits","change",v1),i("gone","change",()=>{re.gone=te("gone").checked,Kn(re.t)});for(let t of["filter","filter-low","filter-high"])i(t,"change",A1);let e=()=>{let t=j.ids.indexOf(Number(te("wanted").value));te("wanted").value.trim()===""||t<0?Cr("No such body."):Er(t)};i("choose","click",e),i("wanted","keydown",t=>{t.key==="Enter"&&e()}),i("opacity","change",Ga),i("names","change",()=>{Jn=!0}),i("slice","change",gd),i("normal","change",q0),i("offset","input",()=>{let[t,n]=zt.range(zt.normal);ka(t+Number(te("offset").value)*(n-t))}),i("streams","change",Ga),x1(),i("home","click",()=>He.goHome()),i("whole","click",()=>He.showAll(J0())),i("theme","change",()=>Lh(te("theme").value)),i("picture","click",n_),i("help","click",()=>te("about").showModal()),i("follow","change",()=>xd(te("follow").checked)),i("keep","change",()=>u1(te("keep").checked)),i("open-plot","click",()=>Ba(te("plot").hidden)),i("plot-close","click",()=>{Ba(!1),te("open-plot").focus()}),i("plot-clear","click",()=>pd(null)),i("card-close","click",()=>{Er(-1),te("canvas").focus()}),i("card-next","click",()=>Dh(1)),i("card-previous","click",()=>Dh(-1)),i("card-table","click",b1),i("open-panel","click",()=>Nh(!0)),i("close-panel","click",()=>{Nh(!1),te("open-panel").focus()}),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>Lh(te("theme").value)),document.addEventListener("keydown",E1)}function E1(i){if(i.ctrlKey||i.metaKey||i.altKey||te("about").open)return;let e=i.target;if(e.matches("input[type=text], select"))return;let t=e.matches("input[type=range]"),n=e.matches("button, summary, input[type=checkbox]"),s={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]}[i.key];if(s){if(t||e!==te("canvas"))return;i.shiftKey?He.move(-40*s[0],40*s[1]):He.turn(-.09*s[0],-.09*s[1]),i.preventDefault();return}if(i.key===" "&&n)return;let r={" ":()=>Do(!re.playing),",":()=>Po(-1),".":()=>Po(1),"+":()=>He.zoom(.85),"=":()=>He.zoom(.85),"-":()=>He.zoom(1/.85),n:()=>Dh(1),p:()=>Dh(-1)};t||Object.assign(r,{Home:()=>Po(-1/0),End:()=>Po(1/0)});for(let[a,,l]of N0)l&&a!=="Space"&&(r[a.length===1?a.toLowerCase():a]=l);let o=r[i.key.length===1?i.key.toLowerCase():i.key];o&&(o(),i.preventDefault())}var i_=r1();i_.catch(i=>{throw te("notice").textContent=`This page cannot be shown: ${i.message}.`,te("notice").classList.add("failed"),i});window.foamprb={ready:i_,state:re,show:Kn,choose:Er,bodyAt:K0,setColour:Oh,setEnlargement:_d,paintPicture:t_,draw:Rh,placeOf:j0,get data(){return j},get eye(){return He},get plot(){return Ar},get bodies(){return wn},get renderer(){return Bn}};})();
/*! Bundled license information:

three/build/three.core.js:
three/build/three.module.js:
  (**
   * @license
   * Copyright 2010-2026 Three.js Authors
   * SPDX-License-Identifier: MIT
   *)
*/
